#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include "sim/schemes/scheme.hpp"
#include "sim/settings.hpp"

namespace drape {

/// Cuts each step into equal substeps of a scheme of second order, with the smallest number that it finds for which no
/// vertex ends further than an accuracy from where it would without error of time stepping and solve. The scheme is
/// velocity Verlet's for explicit methods, and SDIRK2 for implicit ones.
///
/// **The error** is estimated by a second motion beside it, of the same scheme in half as many substeps (solved by
/// quasi-Newton where it is implicit, which is the fastest with long steps). With order p the two part by 2^p − 1 times
/// what the shorter substeps do wrong: three times by Verlet's; SDIRK2 has an order between 2 and 1 where springs are
/// stiff, and 1/0.7 is taken. Accepted is what is four fifths of the accuracy. Both motions advance together, so one
/// that parts too soon is given up where it does.
///
/// **The number** is even, and follows from the state alone. What the first two of the shorter substeps of some number
/// do, in proportion to the step, says with which number to begin; where that is not accurate enough, what has parted
/// by then says with which to go on. An implicit scheme takes 4, 6, 8, 12, 16 …, so that factors can be kept, since
/// fewer do not show what stiff springs do. The cap is 4096 substeps; a step that needs more ends with these and has
/// not converged. liu13 begins with more than it needs where shorter substeps are the cheaper ones.
///
/// **The solve**: a residual force r on a vertex that is the same in every substep moves it by r/m·h²/2 in the step,
/// whatever the number. The tolerance of each solve allows a twentieth of the accuracy for that; but no more than ten
/// times 0.3 % of the weight: where steps are short, hardly anything would be solved otherwise.
///
/// A solve begins where the acceleration of the substep before leads, and one of the longer ones where those beside it
/// do: that takes half of the iterations.
///
/// A substep is a step of a system of its own, in which pins, colliders, corrections and filters act as they do in a
/// step; which vertices are pinned is the step's affair.
class SubstepScheme final : public Scheme {
 public:
  /// What acts on the cloth, with steps of another length [s].
  using MakeSystem = std::function<System(double step)>;

  /// Into how many substeps a step is cut at most, unless stability asks for more.
  static constexpr std::int64_t most_substeps = 4096;

  /// @param settings whose accuracy is given
  /// @param fewest_stable substeps with which the inner scheme is stable, see SubstepGuard
  /// @throws UsageError as MethodType::make does
  SubstepScheme(const SimulationSettings& settings, std::int64_t fewest_stable, MakeSystem make_system);
  ~SubstepScheme() override;

  /// Of the report's iterations, those of all attempts are counted.
  StepReport advance(State& state, StepForces& forces) override;

  // Of the last substep.
  [[nodiscard]] double residual() override;
  [[nodiscard]] double error() override;
  [[nodiscard]] double unbalanced() override;
  [[nodiscard]] std::optional<Accuracy> accuracy() const override;

 private:
  struct Motion;
  class Attempt;

  /// The attempt with so many substeps. Some are kept, because each has its factors.
  Attempt& attempt(std::int64_t substeps, const State& start);
  /// The least number from there on that is tried.
  [[nodiscard]] std::int64_t worthwhile(std::int64_t substeps) const;
  /// With how many to go on when the estimate with so many is this.
  [[nodiscard]] std::int64_t substeps_for(double estimate, std::int64_t substeps) const;

  double step_, accuracy_;  // [s], [m]
  IntegratorSettings integrator_;
  MakeSystem make_system_;
  double acceleration_;                            // that the solves may leave out [m/s²]
  std::int64_t fewest_, most_ = 0, first_ = 0;     // substeps of the shorter motion: of attempts, and to look with
  std::deque<std::unique_ptr<Attempt>> attempts_;  // the last used first
};

}  // namespace drape
