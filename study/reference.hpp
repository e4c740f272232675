#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "run/progress.hpp"
#include "sim/simulation.hpp"

namespace drape {

/// How far two shapes of a cloth are apart, over its vertices [m].
struct Distance {
  double max = 0, rms = 0;
};
Distance distance(const Vertices& a, const Vertices& b);

/// The settings with an implicit method that goes on until an iteration moves the vertices no further than rounding
/// does: the forces are known to ε·|x|·Σk at each vertex, which moves it by at most h²/m times that.
SimulationSettings to_rounding(SimulationSettings settings, Method method);

/// A motion computed by Newton's method to rounding, and beside it by quasi-Newton.
struct ReferenceMotion {
  std::vector<State> states;  ///< at the steps that were asked for: Newton's
  std::vector<double> apart;  ///< how far a vertex of the two is apart at most: [k] after step k+1 [m]

  /// How far the two are apart after a step; 0 before the first.
  [[nodiscard]] double apart_after(std::int64_t step) const {
    return step == 0 ? 0 : apart[static_cast<std::size_t>(step - 1)];
  }
  /// The first step after which they are further apart than the limit [m].
  [[nodiscard]] std::optional<std::int64_t> first_beyond(double limit) const;
};

/// @param keep  steps whose states are kept, ascending; none is beyond `steps`
/// @returns nothing if it was stopped
/// @throws DivergedError
std::optional<ReferenceMotion> run_reference(const SimulationSettings& settings, std::int64_t steps,
                                             const std::vector<std::int64_t>& keep, const std::stop_token& stop,
                                             Progress& progress);

/// The first step after which a motion is further than a limit [m] from what it would be if spheres, grounds, itself
/// and a limit of strain did nothing to the cloth: when it has begun to touch something. Nothing: not within so many
/// steps.
/// @throws DivergedError
std::optional<std::int64_t> first_contact(const SimulationSettings& settings, std::int64_t steps, double limit,
                                          const std::stop_token& stop);

}  // namespace drape
