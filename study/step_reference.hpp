#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>

#include "run/progress.hpp"
#include "sim/simulation.hpp"

namespace drape {

/// Where the cloth would be at a time if steps had no length.
struct StepReference {
  Vertices x;  ///< (4·x(h) − x(2h))/3, in which SDIRK2's error of second order is gone (Richardson's extrapolation) [m]
  double step = 0;    ///< h [s]
  double gained = 0;  ///< how far x(h) is from that: far more than what its own error is [m]
  double apart = 0;   ///< how far Newton's and quasi-Newton's x(2h) are apart [m]
};

/// @param steps from the start of the motion to the time, an even number
/// @returns nothing if it was stopped
/// @throws DivergedError
std::optional<StepReference> extrapolate_step(SimulationSettings settings, double time, std::int64_t steps,
                                              const std::stop_token& stop, Progress& progress);

}  // namespace drape
