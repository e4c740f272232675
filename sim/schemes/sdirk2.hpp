#pragma once

#include <numbers>
#include <optional>

#include "sim/schemes/backward_euler.hpp"
#include "sim/schemes/stability_guard.hpp"
#include "sim/stability.hpp"

namespace drape {

/// The singly diagonally implicit Runge-Kutta method of two stages and second order (Alexander 1977, theorem 5), which
/// is L-stable. With γ = 1 − 1/√2, a(x) = M⁻¹(f − ∇E(x)):
///   stage 1:  V₁ = v + γh a(X₁),                   X₁ = x + γh V₁,
///   stage 2:  V₂ = v + (1−γ)h a(X₁) + γh a(X₂),    X₂ = x + (1−γ)h V₁ + γh V₂,
/// and the step ends with x' = X₂, v' = V₂. Each stage is a step of backward Euler of γh seconds, the second one from
///   x₂ = x + (1−γ)h V₁,   v₂ = v + (1−γ)/γ·(V₁ − v).
/// So a solver minimises a StepObjective of that length twice, with one matrix for both.
///
/// Explicit forces that depend on the position are evaluated once, at the predicted mid-step positions x + h/2·v. For a
/// vertex without springs the step equals velocity Verlet's, with the same largest stable step. Forces that depend on
/// velocities (air) are evaluated at the start of the step and in stage 1, with the weights δ = 1 − 1/(2γ) and 1 − δ
/// (Ascher, Ruuth and Spiteri 1997, section 2.6). Velocity fields are part of a(x), with each stage's velocity V, see
/// FieldSolve. Corrections are applied in two halves. All of this has second order and preserves equilibria. Filters
/// change the path from x to X₂, and v' accordingly.
///
/// A step with contact uses backward Euler. An impact reduces every scheme to first order, and its force in stage 1
/// would persist in stage 2 after the contact has ended.
///
/// A linear cloth gains no energy in any step. A nonlinear one may, as the method is not algebraically stable:
/// (1 − γ)(3γ − 1) < 0. Sdirk2Guard watches for this.
class Sdirk2 final : public MinimisingScheme {
 public:
  /// Fraction of the step per stage.
  static constexpr double gamma = 1 - std::numbers::sqrt2 / 2;

  Sdirk2(const System& system, const MakeSolver& make_solver);

  StepReport advance(State& state, StepForces& forces) override;
  void expect(const Vertices& early, const Vertices& late) override;
  [[nodiscard]] bool first_order() const override { return touched_; }
  [[nodiscard]] double residual() override;
  [[nodiscard]] double error() override;
  [[nodiscard]] double residual_force() override;

 private:
  /// Advances a step without contact.
  StepReport advance_freely(State& state, StepForces& forces);
  /// Computes the forces of the first stage: sets force_, and of_start_ for those that depend on velocities.
  void find_forces(const State& state, StepForces& forces);
  /// Computes the forces of the second stage such that the step has the weights δ and 1 − δ.
  void find_second_forces(double time, StepForces& forces);
  /// Takes a step of backward Euler of γh seconds from stage_, which becomes its end; see choose_point().
  void solve(double end, const Vertices* expected, StepReport& report);

  State stage_;
  Vertices force_;                         // of a stage [N]
  Vertices of_start_, of_stage_, way_;     // velocity-dependent forces [N]; scratch
  Vertices of_fields_;                     // mean force of the velocity fields [N]
  std::optional<BackwardEuler> touching_;  // for steps with contact, if the cloth can touch anything
  bool touched_ = false;                   // true if the last step had contact
  State before_;
};

/// Guard for SDIRK2, which shares the limits of backward Euler but may gain energy. In tests with steps up to 46 ms and
/// tight solves, a motion never exceeded 1.6 times its initial and supplied energy. Even that occurred only if it
/// started crumpled into a line or a point. But a stiff cloth that crumples within a step of 0.1 s reached 38 times.
/// Also, an error δ of a loose solve puts k δ² into a spring, and the second stage starts with five times the error.
/// Beyond ten times the explained energy the motion is not physical.
class Sdirk2Guard final : public StabilityGuard {
 public:
  static constexpr double limit = 10;

  explicit Sdirk2Guard(const System& system);

  [[nodiscard]] std::optional<std::string> problem() const override { return condition_.problem(); }
  [[nodiscard]] double longest_step() const override { return condition_.longest_step(); }
  void begin(const State& state, const EnergyNow& energy) override;
  std::optional<double> look(const State& state, const Vertices& push, bool constant, const EnergyNow& energy) override;
  [[nodiscard]] std::optional<BlowUpWatch::EnergyHistory> books() const override;
  void go_on(const BlowUpWatch::EnergyHistory& books) override;
  [[nodiscard]] std::string remedy() const override;

 private:
  ConditionGuard condition_;
  std::optional<BlowUpWatch> watch_;  // if only forces give the cloth energy
};

}  // namespace drape
