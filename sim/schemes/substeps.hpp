#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include "sim/schemes/scheme.hpp"
#include "sim/settings.hpp"

namespace drape {

/// Cuts each step into 2^k equal substeps of another scheme, with the smallest k that it finds for which no vertex ends
/// further than an accuracy from where it would without error of time stepping and solve.
///
/// **The error** is estimated by a second motion beside it, of second order and in substeps four times as long
/// (Verlet's where the scheme is explicit, SDIRK2's solved by quasi-Newton where it is implicit, which is the fastest
/// with long steps). Beside a scheme of first order that is a pair of two orders: the longer substeps do far less wrong
/// than the shorter ones, and the two part by what these do. A scheme of second order is its own pair: the two part by
/// 4^p − 1 times what the shorter ones do wrong, where p is between 1 (very stiff springs) and 2; 9 is taken for that.
/// Both motions advance together, so one that parts too soon is given up where it does.
///
/// **Where the step ends**: half way between the two, where the scheme is backward Euler and nothing filters the
/// motion. That takes half of the error away, and half of the distance is what is left. Both motions damp what swings
/// (of a linear cloth neither gains energy), and so does their mean. Elsewhere a step ends where the shorter substeps
/// do, and the whole distance is the error: a mean of two explicit motions, which damp nothing, may grow where springs
/// swing in time with the substeps, and what filters have kept apart may be too near half way between.
///
/// **Semi-implicit Euler** loses half of its error in another way, and without an evaluation of forces. Kicks and
/// drifts of h each are velocity Verlet's position form, but for half a substep of drifting that is missing before the
/// first kick and too much after the last. So a step drifts a quarter of a substep before its substeps, and as much
/// back after them (where nothing filters the motion). A drift is symplectic, and so is the step; on each frequency it
/// is stable where semi-implicit Euler is, since it is the same but for where on the drift it begins and ends.
///
/// **k** follows from the state alone. What the first of the longer substeps of some k does, in proportion to the step,
/// says with which k to begin; where that is not accurate enough, what has parted by then says with which to go on. The
/// cap is 2^12 substeps; a step that needs more ends with these and has not converged. liu13 begins with more than it
/// needs where shorter substeps are the cheaper ones. Semi-implicit Euler with twice the fewest substeps or more has
/// eight of them beside a longer one.
///
/// **The solve**: a residual force r on a vertex that is the same in every substep moves it by r/m·h²/2 in the step,
/// whatever k. The tolerance of each solve allows a tenth of the accuracy for that (a fifth, where half of it is taken
/// away), less than what an estimate has to show; but no more than ten times the error that is its default, 3 % of the
/// weight: where steps are short, hardly anything would be solved otherwise.
///
/// A solve begins where the acceleration of the substep before leads, and one of the longer ones where those beside it
/// do: that takes half of the iterations.
///
/// A substep is a step of a system of its own, whose time is the same number (number·2^k)·(h·2^−k). So pins, colliders,
/// corrections and filters act in every substep as they do in a step; which vertices are pinned is the step's affair.
class SubstepScheme final : public Scheme {
 public:
  /// What acts on the cloth, with steps of another length [s].
  using MakeSystem = std::function<System(double step)>;

  /// How often a step is cut in two at most, unless stability asks for more.
  static constexpr int most_halvings = 12;

  /// @param settings whose accuracy is given
  /// @param fewest_halvings with which the inner scheme is stable, see SubstepGuard
  /// @throws UsageError as MethodType::make does
  SubstepScheme(const SimulationSettings& settings, int fewest_halvings, MakeSystem make_system);
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

  /// The attempt with 2^k substeps. Some are kept, because each has its factors.
  Attempt& attempt(int halvings, const State& start);
  /// How many halvings the longer substeps have less.
  [[nodiscard]] int gap_for(int halvings) const;
  /// With how many halvings to go on when the estimate with so many is this.
  [[nodiscard]] int halvings_for(double estimate, int halvings) const;

  double step_, accuracy_;  // [s], [m]
  IntegratorSettings integrator_;
  MakeSystem make_system_;
  int order_;
  double acceleration_;        // that the solves may leave out [m/s²]
  int fewest_, most_, first_;  // halvings of the shorter substeps: of the attempts, and to look with
  std::deque<std::unique_ptr<Attempt>> attempts_;  // the last used first
};

}  // namespace drape
