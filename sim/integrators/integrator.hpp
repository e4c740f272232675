#pragma once

#include <memory>

#include "sim/settings.hpp"
#include "sim/system.hpp"

namespace drape {

/// How a step was computed.
struct StepReport {
  int iterations = 0;     ///< linear solves; 0 for a method that has none
  bool converged = true;  ///< whether the stopping rule was met within max_iterations, and every motion filter's too
  double kept = 1;        ///< the part of the way to the last iterate that the step went, see ImplicitEuler
  double rise = 0;        ///< the most by which an iteration raised g beyond what rounding explains [J]: a fault
};

/// Advances a cloth by one step of the system's h.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Moves x and v to the end of the step; leaves state.step to the caller.
  /// @param force the sum of the system's forces at the start of the step, n×3 [N]
  virtual StepReport advance(State& state, const Vertices& force) = 0;

  /// ‖∇g‖ [N] where the last step ended: the 2-norm of the forces left out of balance on all unknowns together.
  /// Zero for a method that minimises nothing. Not counted in the step: it is evaluated when asked for.
  [[nodiscard]] virtual double residual() { return 0; }
};

/// The integrator that the settings name. Keeps a reference to the system.
std::unique_ptr<Integrator> make_integrator(const IntegratorSettings& settings, const System& system);

}  // namespace drape
