#pragma once

#include <numbers>
#include <optional>

#include "sim/schemes/backward_euler.hpp"

namespace drape {

/// The singly diagonally implicit Runge-Kutta method of two stages and second order (Alexander 1977, theorem 5), which
/// is L-stable. With γ = 1 − 1/√2, a(x) = M⁻¹(f − ∇E(x)):
///   stage 1:  V₁ = v + γh a(X₁),                   X₁ = x + γh V₁,
///   stage 2:  V₂ = v + (1−γ)h a(X₁) + γh a(X₂),    X₂ = x + (1−γ)h V₁ + γh V₂,
/// and the step ends with x' = X₂, v' = V₂. Each stage is a step of backward Euler of γh seconds, the second one from
///   x₂ = x + (1−γ)h V₁,   v₂ = v + (1−γ)/γ·(V₁ − v),
/// so a solver minimises a StepObjective of that length twice, and has one matrix for both.
///
/// Explicit forces: those that depend on the place are evaluated once, where the cloth would be in the middle of the
/// step by its velocity, x + h/2·v, so that for a vertex without springs the step is velocity Verlet's, with its
/// largest stable step. Those that depend on velocities (air) are evaluated at the start of the step and in stage 1,
/// with the weights δ = 1 − 1/(2γ) and 1 − δ (Ascher, Ruuth and Spiteri 1997, section 2.6). Velocity fields are in
/// a(x), with the velocity V of each stage, see FieldSolve. What corrections do is halved. All of that is of second
/// order, and leaves a cloth in equilibrium where it is. Filters change the way from x to X₂, and v' by as much.
///
/// A step in which the cloth touches anything is one of backward Euler: an impact makes every scheme one of first
/// order, and the force that ends it in stage 1 would go on in stage 2, where nothing is touched any more.
///
/// Of a linear cloth no step gains energy. Of others it may: the method is not algebraically stable, since (1 − γ)(3γ −
/// 1) < 0, so Sdirk2Guard keeps an eye on it.
class Sdirk2 final : public MinimisingScheme {
 public:
  /// The part of a step that each stage solves for.
  static constexpr double gamma = 1 - std::numbers::sqrt2 / 2;

  Sdirk2(const System& system, const MakeSolver& make_solver);

  StepReport advance(State& state, StepForces& forces) override;
  void expect(const Vertices& early, const Vertices& late) override;
  [[nodiscard]] double residual() override;
  [[nodiscard]] double error() override;
  [[nodiscard]] double unbalanced() override;

 private:
  /// A step in which nothing is touched.
  StepReport advance_freely(State& state, StepForces& forces);
  /// The forces of the first stage: sets force_, and of those that depend on velocities of_start_.
  void find_forces(const State& state, StepForces& forces);
  /// Of the second: as force_ they give the step what the weights δ and 1 − δ do.
  void find_second_forces(double time, StepForces& forces);
  /// A step of backward Euler of γh seconds from stage_, which becomes its end; see choose_point().
  void solve(double end, const Vertices* expected, StepReport& report);

  State stage_;
  Vertices force_;                         // of a stage [N]
  Vertices of_start_, of_stage_, way_;     // of velocities [N]; scratch
  Vertices of_fields_;                     // velocity fields' force, on average [N]
  std::optional<BackwardEuler> touching_;  // for steps in which the cloth touches something, where it can
  bool touched_ = false;                   // whether the last step was one of these
  State before_;
};

}  // namespace drape
