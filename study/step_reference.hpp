#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "run/progress.hpp"
#include "sim/simulation.hpp"

namespace drape {

/// Positions of the cloth at some moments in the limit of vanishing steps.
struct StepReference {
  std::vector<std::int64_t> moments;  ///< step numbers of the scene, ascending
  /// (4·x(h) − x(2h))/3: Richardson extrapolation, which removes the second-order error [m].
  std::vector<Vertices> x;
  std::vector<Vertices> plain;  ///< x(h) [m]
  double step = 0;              ///< step length h [s]
  double apart = 0;             ///< distance of x from the extrapolation of doubled steps, at the first moment [m]

  /// Returns the index of a moment in the lists; nothing if it is none.
  [[nodiscard]] std::optional<std::size_t> place(std::int64_t moment) const;
  /// Returns the distance between x(h) and x [m]. In a smooth motion it is far larger than the error of x.
  [[nodiscard]] double gained(std::size_t place) const;
};

/// Computes the reference with Verlet, the cheapest method, if it computes all effects and is stable with four times
/// the step. Its steps may be shorter than requested for that. Otherwise uses SDIRK2, solved to rounding by
/// quasi-Newton. Halves Verlet's steps while the extrapolation gains more than `wanted` and each halving helps.
/// @param moments in the scene's steps, ascending, unique
/// @param parts   fewest reference steps per step of the scene, a multiple of four
/// @param wanted  largest gain of the extrapolation at the first moment [m]
/// @returns nothing if stopped
/// @throws DivergedError
std::optional<StepReference> extrapolate_steps(SimulationSettings settings, std::vector<std::int64_t> moments,
                                               std::int64_t parts, double wanted, const std::stop_token& stop,
                                               Progress& progress);

}  // namespace drape
