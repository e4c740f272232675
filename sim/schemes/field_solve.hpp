#pragma once

#include "sim/field_drag.hpp"
#include "sim/solvers/anderson.hpp"
#include "sim/solvers/minimiser.hpp"
#include "sim/step_objective.hpp"

namespace drape {

/// Solves for what velocity fields do at the end of an implicit step of τ seconds. With FieldDrag in g and m c for the
/// rest of their force, the step ends at x(c) = argmin g; there the fields' acceleration is a(x, (x − x₀)/τ), and c is
/// right where
///   c = T(c) = a + Q (x(c) − x₀).
/// This is iterated with Anderson's acceleration, each time from where the last minimum was, until the change of c
/// moves no vertex by more than the tolerance. Q is taken where the cloth would be by its velocity, and anew where the
/// first minimum is and after every few more. Of a free vertex T' = τ²(G + Q) is what of the fields has no potential
/// that takes energy (the Lorentz or Coriolis force, say), and of others less.
class FieldSolve {
 public:
  FieldSolve(const System& system, const StepObjective& objective);

  /// Begins a step from a state that ends at a time [s].
  void begin(const State& from, double end);
  /// The fields' part of the force beside `others`, m c + others, n×3 [N]. Holds until the next call.
  const Vertices& force_with(const Vertices& others);
  /// Takes note of the minimum that followed, and returns whether another is needed, with another c. Moves it to where
  /// that would be without springs, or to where nothing is a number if the fields are none there. Where c is not found,
  /// the last minimum is the one of the c that was nearest.
  bool improve(Vertices& x, const Minimiser& minimiser);
  /// Returns whether c is right to the tolerance.
  [[nodiscard]] bool converged() const { return converged_; }
  /// Ends the step. Returns what the fields gave at its end, n×3 [N].
  const Vertices& end();

 private:
  /// Makes error_ how far a change of c by the residual would move a free vertex; returns whether that is negligible.
  [[nodiscard]] bool negligible(const Vertices& x, const Minimiser& minimiser);
  /// Replaces c by what is nearer, and moves x with it.
  void advance(Vertices& x);

  const System& system_;
  const StepObjective& objective_;
  VelocityFields fields_;
  FieldDrag& drag_;
  AndersonHistory history_;
  State state_;                                // at the end of the step
  Vertices start_, c_, acceleration_, force_;  // x₀; [m/s²], [m/s²], [N]
  Vertices residual_, before_;                 // T(c) − c, and the c before [m/s²]
  Vertices best_c_, best_x_;                   // where an error was the least…
  double time_ = 0;
  double error_ = 0, least_error_ = 0;  // …of this size [m], or [N] by a rule of the gradient
  int rounds_ = 0;
  bool over_ = false, converged_ = false;
};

}  // namespace drape
