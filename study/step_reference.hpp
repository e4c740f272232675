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
  double apart = 0;  ///< how far from x what is extrapolated from twice these steps is at the first moment [m]

  /// Its place in the lists; nothing for a step that is no moment.
  [[nodiscard]] std::optional<std::size_t> place(std::int64_t moment) const;
  /// How far x(h) is from what is extrapolated: far more than what its own error is, as long as the motion is smooth
  /// [m].
  [[nodiscard]] double gained(std::size_t place) const;
};

/// Verlet's steps, the cheapest, where everything that acts can be computed so and four times as long ones are stable
/// (they may be shorter than asked for that); or else SDIRK2's, solved to rounding by quasi-Newton. Verlet's are halved
/// while what is extrapolated gains more than is wanted and each halving gains.
/// @param moments by the scene's steps, ascending, none twice
/// @param parts   how many steps of the reference there are in one of the scene's at least, a multiple of four
/// @param wanted  what the extrapolation may gain at the first moment at most [m]
/// @returns nothing if it was stopped
/// @throws DivergedError
std::optional<StepReference> extrapolate_steps(SimulationSettings settings, std::vector<std::int64_t> moments,
                                               std::int64_t parts, double wanted, const std::stop_token& stop,
                                               Progress& progress);

}  // namespace drape
