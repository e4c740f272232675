#pragma once

#include <cstdint>
#include <span>
#include <stop_token>

#include "run/step_observer.hpp"

namespace drape {

/// Advances a simulation until it has done that many steps in all, telling the observers, in their order. Returns early
/// when a stop is requested.
/// @throws DivergedError after the observers saw the last finite step
void run_steps(Simulation& simulation, std::int64_t steps, std::span<StepObserver* const> observers,
               const std::stop_token& stop);

}  // namespace drape
