#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "drape/sim/settings.hpp"
#include "sim/schemes/scheme.hpp"

namespace drape {

/// A second-order scheme that divides each step into equal substeps, such that no vertex ends further than the accuracy
/// from the solution without time-stepping and solver errors. The scheme is velocity Verlet for explicit methods, and
/// SDIRK2 for implicit ones.
///
/// **Error estimate**: c·h²·Σ‖aₖ₊₁ − aₖ‖ of the worst vertex, with the mean acceleration aₖ of substep k of h seconds.
/// A substep of Verlet errs by h³/12·a' in x. So c = 1/12 for a force that changes steadily, and half of that for an
/// oscillation, whose phase errs by (ωh)²/24 of ωt. SDIRK2 has 0.0404 (3γ² − 2γ³ − 1/6) in place of 1/24; c is 1/16,
/// which covers stiff springs that it damps. A substep of first order (contact) adds h²/2·‖aₖ‖. No force is evaluated
/// for the estimate. A step is accepted below 0.6 of the accuracy; an attempt ends once it is above.
///
/// **Number of substeps**: at least two (implicit: four, for stiff springs), and 1.2 times as many as stability
/// requires. State::substeps holds the number for the next step: the last one while its estimate is between 0.15 and
/// 0.45 of the accuracy, otherwise the one for 0.35, at least half the last. Implicit schemes use 4, 6, 8, 12, 16 … to
/// reuse factors. The cap is 4096 substeps. A step that needs more ends with these and has not converged. liu13 uses
/// more than needed if shorter substeps are cheaper.
///
/// **Solver tolerance**: the default one, about a tenth of a substep's own error. A constant residual force r on a
/// vertex moves it by r/m·h²/2 in the step for any number of substeps; the limit is a tenth of the accuracy.
///
/// Initial guesses follow the last acceleration, which saves iterations.
///
/// A substep is a step of its own system: pins, colliders, corrections and filters act as in a step. The set of pinned
/// vertices is constant during a step.
class SubstepScheme final : public Scheme {
 public:
  /// Function that makes the system with another step length [s].
  using MakeSystem = std::function<System(double step)>;

  /// Maximum number of substeps per step, unless stability requires more.
  static constexpr std::int64_t most_substeps = 4096;

  /// @param settings with an accuracy
  /// @param fewest_stable stable number of substeps of the inner scheme, see SubstepGuard
  /// @throws UsageError as MethodType::make does
  SubstepScheme(const SimulationSettings& settings, std::int64_t fewest_stable, MakeSystem make_system);
  ~SubstepScheme() override;

  /// Advances by a step. The report's iterations include all attempts.
  StepReport advance(State& state, StepForces& forces) override;

  // Values of the last substep.
  [[nodiscard]] double residual() override;
  [[nodiscard]] double error() override;
  [[nodiscard]] double residual_force() override;
  [[nodiscard]] std::optional<Accuracy> accuracy() const override;

 private:
  class Motion;

  /// Returns the motion with this number of substeps. Recent ones are kept, as each has its own factors.
  Motion& motion(std::int64_t substeps, const State& start);
  /// Returns the next number of substeps to try, at least `substeps`.
  [[nodiscard]] std::int64_t worthwhile(std::int64_t substeps) const;
  /// Returns the number of substeps to aim at, from the estimate for another number.
  [[nodiscard]] std::int64_t substeps_for(double estimate, std::int64_t substeps) const;
  /// Returns the number of substeps to begin the next step with, from the estimate of the last one.
  [[nodiscard]] std::int64_t next_substeps(double estimate, std::int64_t substeps) const;

  double step_, accuracy_;  // [s], [m]
  IntegratorSettings integrator_;
  MakeSystem make_system_;
  double solve_limit_;                           // residual acceleration of a solve [m/s²]
  std::int64_t fewest_, most_ = 0;               // limits of the number of substeps
  std::deque<std::unique_ptr<Motion>> motions_;  // most recently used first
};

/// An explicit scheme that divides each step into equal substeps: System::substeps of System::step seconds. A substep
/// is a step in every respect except that State::step counts it differently.
class DividedStep final : public Scheme {
 public:
  /// @param scheme for the same system
  DividedStep(const System& system, std::unique_ptr<Scheme> scheme) : system_(system), scheme_(std::move(scheme)) {}

  StepReport advance(State& state, StepForces& forces) override;
  [[nodiscard]] std::optional<double> size() const override { return scheme_->size(); }

 private:
  const System& system_;
  std::unique_ptr<Scheme> scheme_;
};

}  // namespace drape
