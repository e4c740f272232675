#pragma once

#include <span>
#include <stop_token>

#include "check/rounding.hpp"
#include "run/step_observer.hpp"

namespace drape {

/// Runs the golden motion: in windows, each of which begins with the rounded end state of the previous one. Calls every
/// observer's begin() for each window, and once more at the end. Returns early when a stop is requested.
/// @param simulation before its first step
/// @param starts     first steps of the windows, and the last step, see window_starts()
/// @throws DivergedError after the observers saw the last finite step
void run_chained(Simulation& simulation, std::span<const std::int64_t> starts, const RoundingUnits& quanta,
                 std::span<StepObserver* const> observers, const std::stop_token& stop);

}  // namespace drape
