#pragma once

#include <span>
#include <stop_token>

#include "check/rounding.hpp"
#include "run/step_observer.hpp"

namespace drape {

/// Runs a motion in windows, of which each begins with the rounded end of the one before: that is the golden motion.
/// Every observer's begin() is called for each window, and once more for the motion's end. Returns early when a stop is
/// requested.
/// @param simulation before its first step
/// @param starts     first steps of the windows, and the last step, see window_starts()
/// @throws DivergedError after the observers saw the last finite step
void run_chained(Simulation& simulation, std::span<const std::int64_t> starts, const Quanta& quanta,
                 std::span<StepObserver* const> observers, const std::stop_token& stop);

}  // namespace drape
