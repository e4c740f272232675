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

/// A second-order scheme that divides each step into equal substeps. It uses the smallest number it finds for which no
/// vertex ends further than the accuracy from the solution without time-stepping and solver errors. The scheme is
/// velocity Verlet for explicit methods, and SDIRK2 for implicit ones.
///
/// **Error estimate**: a companion motion uses the same scheme with half as many substeps. If implicit, it is solved by
/// quasi-Newton, the fastest method for long steps. With order p the two differ by 2^p − 1 times the error of the
/// shorter substeps: three times for Verlet. SDIRK2 has an order between 2 and 1 for stiff springs; 1/0.7 is used. A
/// step is accepted below four fifths of the accuracy. Both motions advance together, so that an attempt stops once
/// they differ too much.
///
/// **Number of substeps**: even, and determined by the state alone. A trial of two of the shorter substeps gives the
/// initial number from the error per time. If that is not accurate enough, the difference so far gives the next number.
/// Implicit schemes use 4, 6, 8, 12, 16 … to reuse factors; fewer do not resolve stiff springs. The cap is 4096
/// substeps. A step that needs more ends with these and has not converged. liu13 starts with more than needed if
/// shorter substeps are cheaper.
///
/// **Solver tolerance**: a constant residual force r on a vertex moves it by r/m·h²/2 in the step for any number of
/// substeps. Each solve may use a twentieth of the accuracy for that, up to ten times 0.3 % of the weight. Without this
/// limit short steps would hardly be solved at all.
///
/// Initial guesses follow the last acceleration; those of the longer substeps follow the accelerations of the shorter
/// ones. This saves half of the iterations.
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
  struct Motion;
  class Attempt;

  /// Returns the attempt with this number of substeps. Recent ones are kept, as each has its own factors.
  Attempt& attempt(std::int64_t substeps, const State& start);
  /// Returns the next number of substeps to try, at least `substeps`.
  [[nodiscard]] std::int64_t worthwhile(std::int64_t substeps) const;
  /// Returns the number of substeps to continue with, from the estimate for another number.
  [[nodiscard]] std::int64_t substeps_for(double estimate, std::int64_t substeps) const;

  double step_, accuracy_;  // [s], [m]
  IntegratorSettings integrator_;
  MakeSystem make_system_;
  double acceleration_;  // residual acceleration allowed in a solve [m/s²]
  // Numbers of substeps of the shorter motion: limits, and for the first trial.
  std::int64_t fewest_, most_ = 0, first_ = 0;
  std::deque<std::unique_ptr<Attempt>> attempts_;  // most recently used first
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
