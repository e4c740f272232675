#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "sim/contact/contact_solver.hpp"
#include "sim/dashpots.hpp"
#include "sim/parallel/vectors.hpp"
#include "sim/schemes/energy_balance.hpp"
#include "sim/schemes/field_solve.hpp"
#include "sim/schemes/scheme.hpp"
#include "sim/schemes/stability_guard.hpp"
#include "sim/solvers/minimiser.hpp"
#include "sim/stability.hpp"

namespace drape {

/// Base of schemes that minimise a StepObjective once or more per step. Holds the solver and the result of the last
/// minimisation, which ends the step.
class MinimisingScheme : public Scheme {
 public:
  using MakeSolver = std::function<std::unique_ptr<Minimiser>(const StepObjective& objective)>;

  void expect(const Vertices& early, const Vertices& late) override { expected_ = {&early, &late}; }
  [[nodiscard]] double residual() override { return norm(system_.threads, point_.gradient); }
  [[nodiscard]] double error() override { return solver_->error(point_); }
  [[nodiscard]] double residual_force() override { return point_.gradient.rowwise().norm().sum(); }
  [[nodiscard]] std::optional<Accuracy> accuracy() const override { return solver_->accuracy(); }

 protected:
  /// Positions that give the dashpots their directions in a minimisation: the first ones, where their forces keep the
  /// angular momentum of a step of backward Euler; or the last ones as predicted by the velocities, for second order.
  enum class Directions { at_start, predicted };

  /// @param duration time covered by one minimisation [s]
  /// @param dashpots  their directions in a minimisation
  MinimisingScheme(const System& system, double duration, const MakeSolver& make_solver, Directions dashpots)
      : system_(system),
        objective_(system, duration),
        solver_(make_solver(objective_)),
        point_{.x = system.cloth.positions, .gradient = Vertices::Zero(system.cloth.vertex_count(), 3)},
        free_(is_free(system)),
        dashpots_(dashpots),
        other_(point_) {
    if (system.drag != nullptr) fields_.emplace(system, objective_);
  }

  /// Begins the objective from a state under forces, n×3 [N], and minimises it. Repeats this until velocity fields are
  /// consistent with the minimum.
  /// @param expected see choose_point()
  /// @param begun    called each time the objective has begun
  /// @param minimise minimises from the point
  template <class Begun, class Minimise>
  StepReport solve_with_fields(const State& from, const Vertices& force, double end, const Vertices* expected,
                               const Begun& begun, const Minimise& minimise) {
    begin_dissipations(from, end);
    const auto start = [&](const Vertices& all) {
      objective_.begin(from.x, from.v, all, end);
      begun();
    };
    if (!fields_) {
      start(force);
      begin_point(from, expected);
      return minimise();
    }
    fields_->begin(from, end);
    start(fields_->force_with(force));
    begin_point(from, expected);
    StepReport report = minimise();
    while (fields_->improve(point_.x, *solver_)) {
      start(fields_->force_with(force));
      point_.value = objective_.evaluate(point_.x, point_.gradient);
      const StepReport again = minimise();
      report.iterations += again.iterations;
      report.converged = again.converged;
      report.rise = std::max(report.rise, again.rise);
      // A solve in contact that ends at its limit of iterations would under other forces too, and each costs factors.
      if (!again.converged && !system_.contacts.empty()) break;
    }
    report.converged = report.converged && fields_->converged();
    return report;
  }

  struct Expected {
    const Vertices *early = nullptr, *late = nullptr;
  };
  /// Returns the expected accelerations and clears them, so that they serve this step only.
  Expected take_expected() { return std::exchange(expected_, {}); }

  /// Begins a step's minimisations at choose_point().
  void begin_point(const State& from, const Vertices* expected) {
    choose_point(from, expected);
    solver_->begin_step(point_);
  }

  const System& system_;
  StepObjective objective_;
  std::unique_ptr<Minimiser> solver_;
  Iterate point_;
  bool free_;                         // see is_free()
  std::optional<FieldSolve> fields_;  // if there are velocity fields

 private:
  /// Begins the energies of the dashpots in a minimisation from a state to a time [s].
  void begin_dissipations(const State& from, double end) {
    if (system_.dissipations.empty()) return;
    const double t = objective_.duration();
    const bool predicted = dashpots_ == Directions::predicted;
    if (predicted) {
      sum(system_.threads, from.x, t, from.v, ahead_);
      system_.place_pins(end, ahead_);
    }
    for (StepDissipation* one : system_.dissipations) one->begin(predicted ? ahead_ : from.x, from.x, t);
  }

  /// Sets the initial guess of a minimisation from a state. It follows the expected acceleration, or else starts at the
  /// objective's y with the restraint's acceleration added. With the error rule it uses the end of the step under
  /// constant initial forces if g is lower there, which is exact at rest.
  void choose_point(const State& from, const Vertices* expected) {
    const double t = objective_.duration();
    const Vertices& held_back = from.restraint.acceleration;
    const bool held = expected == nullptr && held_back.rows() == from.x.rows() && !held_back.isZero(0);
    if (expected != nullptr || held) {
      if (held) {
        point_.x = objective_.y() + t * t * held_back;
      } else {
        point_.x = from.x + t * from.v + t * t * *expected;
      }
      for (const int pin : system_.cloth.pins) point_.x.row(pin) = objective_.y().row(pin);
      point_.value = objective_.evaluate(point_.x, point_.gradient);
      if (std::isfinite(point_.value)) return;
    }
    copy(system_.threads, objective_.y(), point_.x);
    point_.value = objective_.evaluate(point_.x, point_.gradient);
    if (solver_->accuracy().rule != StoppingRule::error) return;
    objective_.predict_with_start_forces(other_.x, other_.gradient);
    other_.value = objective_.evaluate(other_.x, other_.gradient);
    if (other_.value < point_.value) std::swap(point_, other_);
  }

  Directions dashpots_;
  Vertices ahead_ = objective_.y();  // predicted positions
  Expected expected_;
  Iterate other_;  // alternative initial guess
};

/// Backward (implicit) Euler as a minimisation: x' = argmin g, v' = (x' − x)/h, then the corrections. It gains no
/// energy beyond the tolerance of EnergyBalance.
///
/// For a free cloth every solve ends with balance_momentum().
class BackwardEuler final : public MinimisingScheme {
 public:
  /// @param instantaneous true if velocities are instantaneous, as in steps of SDIRK2; false if they are step means
  BackwardEuler(const System& system, const MakeSolver& make_solver, bool instantaneous = false);

  StepReport advance(State& state, StepForces& forces) override;

  [[nodiscard]] double residual() override;
  [[nodiscard]] double error() override;
  [[nodiscard]] double residual_force() override;

  /// Returns true if contacts keep a cloth from moving straight from a state to x in the step that begins there.
  /// Requires something that the cloth can touch.
  [[nodiscard]] bool is_blocked_by_contact(const State& from, const Vertices& x);
  /// Returns true if pins violate contacts of the cloth with itself, see ContactSolver::is_lost().
  [[nodiscard]] bool is_lost() const { return contact_ && contact_->is_lost(); }

 private:
  /// Shortens the step until it gains no energy, along a path free of collisions. Returns the remaining fraction.
  /// @param held true if contacts hold the cloth
  double shorten(bool held);
  /// Does so in contact with moving obstacles or pins, unless they would move into the cloth.
  /// @param work  that they may do [J]
  /// @param way   mean way of obstacles and pins [m]
  /// @param force of all contacts [N]
  double shorten_beside_moving(double work, const Eigen::RowVector3d& way, const Eigen::RowVector3d& force);

  /// Shortens a solved step that gains energy, and reports it as not converged.
  void remove_gain(StepReport& report);

  /// Lets the filters change the end of a step without contact, which the point is. Returns false if this would gain
  /// energy or lead into contact; the limits must then be solved with the cloth.
  bool limit_strain(State& state, StepReport& report);

  /// Gives a free cloth in contact with itself the momentum that the forces of the step leave it, unless the cloth then
  /// collides.
  void balance_in_contact();

  /// Minimises the objective from the point, under the contacts of a step that began at contact_->begin().
  /// Gives a free cloth that no obstacle holds the momentum of its forces.
  /// @param steady positions reached at constant velocities; empty without contacts
  StepReport solve_step(const Vertices& steady, const std::function<bool()>& may_end);

  bool instantaneous_;
  EnergyBalance balance_;
  std::optional<ContactSolver> contact_;   // if the cloth can touch anything
  std::optional<ContactProblem> problem_;  // of contact, created on first use
  bool touched_ = false;                   // true if the last step was solved under contacts
  Iterate limited_;                        // end of a step after the filters
  Vertices steady_;                        // positions reached at constant velocities; empty without contacts
  Restraint nothing_held_;                 // of a step that the filters did not change
  Vertices limited_v_;                     // mean velocity until there [m/s]
};

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
/// (1 − γ)(3γ − 1) < 0. Backward Euler redoes steps in which Sdirk2Guard finds a gain.
class Sdirk2 final : public MinimisingScheme {
 public:
  /// Fraction of the step per stage.
  static constexpr double gamma = 1 - std::numbers::sqrt2 / 2;

  Sdirk2(const System& system, const MakeSolver& make_solver);

  StepReport advance(State& state, StepForces& forces) override;
  [[nodiscard]] bool first_order() const override { return by_euler_; }
  [[nodiscard]] bool can_redo() const override { return true; }
  StepReport redo(State& state, StepForces& forces) override;
  [[nodiscard]] std::optional<double> energy_bound(const State& state) const override;
  [[nodiscard]] double residual() override;
  [[nodiscard]] double error() override;
  [[nodiscard]] double residual_force() override;

 private:
  /// Advances a step without contact.
  StepReport advance_freely(State& state, StepForces& forces);
  /// Returns true if the filters have added energy to the end of the step that the second stage found.
  [[nodiscard]] bool filters_gain(const State& state);
  /// Computes the forces of the first stage: sets force_, and of_start_ for those that depend on velocities.
  void find_forces(const State& state, StepForces& forces);
  /// Computes the forces of the second stage such that the step has the weights δ and 1 − δ.
  void find_second_forces(double time, StepForces& forces);
  /// Takes a step of backward Euler of γh seconds from stage_, which becomes its end; see choose_point().
  void solve(double end, const Vertices* expected, StepReport& report);

  State stage_;
  Vertices force_;                      // of a stage [N]
  Vertices of_start_, of_stage_, way_;  // velocity-dependent forces [N]; scratch
  Vertices of_fields_;                  // mean force of the velocity fields [N]
  MakeSolver make_solver_;
  std::optional<BackwardEuler> euler_;  // for steps with contact and for those done again; created on first use
  Expected of_step_;                    // what was expected of the step
  bool by_euler_ = false;               // true if it took the last step
  bool gained_ = false;                 // see filters_gain()
  Iterate limited_ = point_;            // end of a step after the filters
  Vertices pin_velocities_ = point_.x;  // of each vertex's piece, at the end of a step [m/s]
  State before_;
};

/// Guard for SDIRK2, which shares the limits of backward Euler but may gain energy, K + E − W with the work W of the
/// forces: where the cloth is crumpled, and where solves are loose. An error δ puts k δ² into a spring, and the second
/// stage starts with five times the error.
///
/// A step may gain a small share of the energy that the motion was given, the initial energy plus the largest work
/// until then: an error of the discretisation. All steps together may not exceed what was given by more than that. The
/// watch needs forces whose work is known; it is off if pins move or forces have unknown work.
class Sdirk2Guard final : public StabilityGuard {
 public:
  /// Largest gain, as a fraction of the given energy. The homework's motions gain 0.042 in a step of 33 ms.
  static constexpr double most_gain = 0.05;

  explicit Sdirk2Guard(const System& system);

  [[nodiscard]] std::optional<std::string> problem() const override { return condition_.problem(); }
  [[nodiscard]] double longest_step() const override { return condition_.longest_step(); }
  void begin(const State& state, double energy) override;
  std::optional<double> check_step(const State& state, const Vertices& push, bool constant,
                                   const EnergyNow& energy) override;
  [[nodiscard]] const EnergyMemory* memory() const override { return memory_ ? &*memory_ : nullptr; }
  void restore(const EnergyMemory& memory) override;
  [[nodiscard]] std::string remedy() const override;

 private:
  ConditionGuard condition_;
  bool watches_;
  double rounding_;  // see energy_rounding() [J]
  std::optional<EnergyMemory> memory_;
};

}  // namespace drape
