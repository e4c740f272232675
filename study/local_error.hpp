#pragma once

#include <cstdint>
#include <optional>

#include "sim/simulation.hpp"

namespace drape {

/// What a single step does wrong, of time stepping and solve together: where it leads from a state, against where very
/// small steps lead from the same. These are Verlet's, the cheapest, where they are stable and everything that acts can
/// be computed so, or else quasi-Newton's of SDIRK2 to rounding; both are of second order, and what is left of it is
/// extrapolated away.
class LocalErrors {
 public:
  /// @throws UsageError if no small steps can be taken
  explicit LocalErrors(const SimulationSettings& settings);

  struct LocalError {
    double error = 0;    ///< the largest distance of a vertex [m]
    double unknown = 0;  ///< how far the small steps end from what is extrapolated from them [m]
  };

  /// @param after where the step from there ended; nothing if the small steps diverge
  std::optional<LocalError> of_step(const State& before, const Vertices& after);

 private:
  /// @param step that the small ones are parts of [s]
  void make(SimulationSettings small, double step);
  /// Where 2^halvings small steps lead.
  Vertices small_steps(Simulation& simulation, int halvings, State from);

  int halvings_ = 0;
  std::optional<Simulation> small_, twice_;
};

}  // namespace drape
