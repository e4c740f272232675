#pragma once

#include <cstdint>
#include <optional>

#include "drape/sim/solvers/accuracy.hpp"
#include "drape/sim/state.hpp"
#include "sim/step_objective.hpp"
#include "sim/system.hpp"

namespace drape {

/// A time-stepping scheme: discretises M ẍ = f − ∇E in steps of the system's h.
class Scheme {
 public:
  virtual ~Scheme() = default;

  /// Advances x and v to the end of the step; the caller advances state.step. The result depends on the state alone.
  /// @param forces of the system
  virtual StepReport advance(State& state, StepForces& forces) = 0;

  /// Advances by several steps at once, if that is faster than single steps and has the same bits.
  /// @param left number of steps until the state is needed
  /// @returns the number of steps done; 0: none
  virtual std::int64_t advance_at_once(State& /*state*/, StepForces& /*forces*/, std::int64_t /*left*/) { return 0; }

  /// Returns ‖∇g‖ at the end of the last step, the 2-norm of the residual forces over all unknowns [N]. Zero for a
  /// method that minimises nothing. Evaluated on request, outside the step.
  [[nodiscard]] virtual double residual() { return 0; }

  /// Provides expected accelerations for the next step, early in it and at its end, n×3 [m/s²]. An implicit scheme uses
  /// them as an initial guess, which saves iterations. They must stay valid until then.
  virtual void expect(const Vertices& /*early*/, const Vertices& /*late*/) {}

  /// Returns a number that is finite if all positions at the end of the last step are, if the step has found one.
  [[nodiscard]] virtual std::optional<double> size() const { return std::nullopt; }

  /// Returns true if a scheme of second order has taken the last step with first order.
  [[nodiscard]] virtual bool first_order() const { return false; }

  /// Returns true if redo() can take steps.
  [[nodiscard]] virtual bool can_redo() const { return false; }
  /// Advances by the same step as advance(), but gains no energy.
  virtual StepReport redo(State& state, StepForces& forces) { return advance(state, forces); }
  /// Returns an upper bound on K + E after the last step [J], if it is known without an evaluation.
  /// @param state as the step has left it
  [[nodiscard]] virtual std::optional<double> energy_bound(const State& /*state*/) const { return std::nullopt; }

  // Methods that minimise nothing return zero or nothing:

  /// Returns the estimated distance of the worst vertex from the exact solution of the last step [m]; see
  /// Minimiser::error.
  [[nodiscard]] virtual double error() { return 0; }
  /// Returns Σ ‖∇gᵢ‖ at the end of the last step: the sum of the vertices' residual forces [N].
  [[nodiscard]] virtual double residual_force() { return 0; }
  /// Returns the stopping criterion of a step.
  [[nodiscard]] virtual std::optional<Accuracy> accuracy() const { return std::nullopt; }
};

}  // namespace drape
