#pragma once

#include <optional>

#include "sim/solvers/accuracy.hpp"
#include "sim/step_forces.hpp"
#include "sim/step_report.hpp"
#include "sim/system.hpp"

namespace drape {

/// How time advances: a discretisation of M ẍ = f − ∇E in steps of the system's h.
class Scheme {
 public:
  virtual ~Scheme() = default;

  /// Moves x and v to the end of the step; leaves state.step to the caller. The result depends on the state alone.
  /// @param forces of the system
  virtual StepReport advance(State& state, StepForces& forces) = 0;

  /// ‖∇g‖ [N] where the last step ended: the 2-norm of the forces left out of balance on all unknowns together.
  /// Zero for a method that minimises nothing. Not counted in the step: it is evaluated when asked for.
  [[nodiscard]] virtual double residual() { return 0; }

  /// Has the next step expect these accelerations, early in it and at its end, n×3 [m/s²]: what solves for where the
  /// cloth goes begins where they lead, and is the sooner there. They must stay until then.
  virtual void expect(const Vertices& /*early*/, const Vertices& /*late*/) {}

  // Likewise, for a method that minimises nothing zero, and nothing:

  /// How far the worst vertex is from the exact solution of the last step, estimated [m]; see Minimiser::error.
  [[nodiscard]] virtual double error() { return 0; }
  /// Σ ‖∇gᵢ‖ [N] where the last step ended: the forces left out of balance, each vertex's by itself.
  [[nodiscard]] virtual double unbalanced() { return 0; }
  /// When a step is accurate enough.
  [[nodiscard]] virtual std::optional<Accuracy> accuracy() const { return std::nullopt; }
};

}  // namespace drape
