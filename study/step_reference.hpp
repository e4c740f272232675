#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "run/progress.hpp"
#include "sim/simulation.hpp"

namespace drape {

/// Where the cloth would be if steps had no length, at some moments.
struct StepReference {
  std::vector<std::int64_t> moments;  ///< by the scene's steps, ascending
  /// (4·x(h) − x(2h))/3, in which SDIRK2's error of second order is gone (Richardson's extrapolation) [m].
  std::vector<Vertices> x;
  std::vector<Vertices> plain;  ///< x(h) [m]
  double step = 0;              ///< h [s]
  double apart = 0;             ///< how far Newton's and quasi-Newton's x(2h) are apart at the first moment [m]

  /// Its place in the lists; nothing for a step that is no moment.
  [[nodiscard]] std::optional<std::size_t> place(std::int64_t moment) const;
  /// How far x(h) is from what is extrapolated: far more than what its own error is, as long as the motion is smooth
  /// [m].
  [[nodiscard]] double gained(std::size_t place) const;
};

/// @param moments by the scene's steps, ascending, none twice
/// @param parts   how many steps of the reference there are in one of the scene's, an even number
/// @returns nothing if it was stopped
/// @throws DivergedError
std::optional<StepReference> extrapolate_steps(SimulationSettings settings, std::vector<std::int64_t> moments,
                                               std::int64_t parts, const std::stop_token& stop, Progress& progress);

}  // namespace drape
