#pragma once

#include <cstdint>
#include <optional>

#include "sim/simulation.hpp"

namespace drape {

/// True local error of a single step, of time stepping and solve together. Compares the end of the step with that of
/// very small steps from the same state. Verlet's steps are the cheapest and are used if stable and able to compute all
/// effects; otherwise quasi-Newton's with SDIRK2, solved to rounding. Extrapolation removes their second-order error.
class LocalErrors {
 public:
  /// @throws UsageError if small steps are impossible
  explicit LocalErrors(const SimulationSettings& settings);

  struct LocalError {
    double error = 0;    ///< largest distance of a vertex [m]
    double unknown = 0;  ///< distance of the small steps from their extrapolation [m]
  };

  /// Computes the error of the step from `before` to `after`; nothing if the small steps diverge.
  std::optional<LocalError> of_step(const State& before, const Vertices& after);

 private:
  /// @param step of the scene, which the small steps divide [s]
  void make(SimulationSettings small, double step);
  /// Returns the positions after 2^halvings small steps.
  Vertices small_steps(Simulation& simulation, int halvings, State from);

  int halvings_ = 0;
  std::optional<Simulation> small_, twice_;
};

}  // namespace drape
