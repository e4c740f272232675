#pragma once

#include "sim/solvers/anderson.hpp"
#include "sim/solvers/minimiser.hpp"
#include "sim/step_objective.hpp"
#include "sim/velocity_field.hpp"

namespace drape {

/// Solver for the effect of velocity fields at the end of an implicit step of τ seconds. g contains FieldDrag, and m c
/// for the rest of their force, so the step ends at x(c) = argmin g. There the fields' acceleration is a(x, (x −
/// x₀)/τ), and c is the solution of
///   c = T(c) = a + Q (x(c) − x₀).
/// The fixed point is iterated with Anderson acceleration, each time from the last minimum. It stops when the change of
/// c moves no vertex by more than the tolerance. Q is evaluated at the positions predicted by the velocities, again at
/// the first minimum, and after every few more. For a free vertex T' = τ²(G + Q): the part of the fields without a
/// dissipative potential, such as the Lorentz or Coriolis force. For others it is smaller.
class FieldSolve {
 public:
  FieldSolve(const System& system, const StepObjective& objective);

  /// Begins a step that starts at a state and ends at a time [s].
  void begin(const State& from, double end);
  /// Returns the sum of the fields' force and `others`, m c + others, n×3 [N]. Valid until the next call.
  const Vertices& force_with(const Vertices& others);
  /// Processes the minimum x and returns true if another with an updated c is needed. Moves x to the next minimum
  /// without springs, or to NaN if the fields are not finite there. Without convergence the last minimum uses the best
  /// c.
  bool improve(Vertices& x, const Minimiser& minimiser);
  /// Returns true if c is within the tolerance.
  [[nodiscard]] bool converged() const { return converged_; }
  /// Ends the step. Returns the fields' force at its end, n×3 [N].
  const Vertices& end();

 private:
  /// Sets error_ to the move of a free vertex if c changed by the residual. Returns true if that is negligible.
  [[nodiscard]] bool negligible(const Vertices& x, const Minimiser& minimiser);
  /// Replaces c by the next iterate and moves x accordingly.
  void advance(Vertices& x);

  const System& system_;
  const StepObjective& objective_;
  VelocityFields fields_;
  FieldDrag& drag_;
  AndersonIteration iteration_;
  State state_;                                // at the end of the step
  Vertices start_, c_, acceleration_, force_;  // x₀; [m/s²], [m/s²], [N]
  Vertices residual_, before_;                 // T(c) − c, and the previous c [m/s²]
  Vertices best_c_, best_x_;                   // iterate with the least error so far
  double time_ = 0;
  double error_ = 0, least_error_ = 0;  // current and least error [m], or [N] with the gradient rule
  int rounds_ = 0;
  bool over_ = false, converged_ = false;
};

/// Solver for the effect of velocity fields in an explicit step of h seconds. The fields act on single vertices, so
/// their velocities w require only a system of three equations per vertex,
///   w = v + h a(x, (v₀ + w)/2),
/// with velocities v₀ before the step and v after all other forces. This implicit midpoint rule has second order. A
/// force across the velocity keeps the speed and drag adds none. Beside springs it is stable up to the safe step
/// without the field. Backward Euler's rule, w = v + h a(x, w), is not, if a force across the velocity is strong.
class FieldKick {
 public:
  explicit FieldKick(const System& system);

  /// Replaces v by w.
  /// @param x, time position and time [m], [s]
  /// @param before v₀ [m/s]
  /// @return true if the iteration for w converged
  bool kick(const Vertices& x, double time, const Vertices& before, Vertices& v);
  /// Returns the force of the fields, n×3 [N].
  [[nodiscard]] const Vertices& force() const { return force_; }

 private:
  /// Computes a at the mean of the velocities `before` and w.
  void find_acceleration(const Vertices& before, const Vertices& w, double time);

  const System& system_;
  VelocityFields fields_;
  FieldSlopes slopes_;
  State state_;                                  // state for the evaluation of a
  Vertices w_, acceleration_, missing_, force_;  // [m/s], [m/s²], [m/s], [N]
};

}  // namespace drape
