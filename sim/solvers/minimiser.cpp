#include "sim/solvers/minimiser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/parallel/vectors.hpp"

namespace drape {
namespace {

constexpr double sufficient_decrease = 1e-4;  // Armijo's constant (Nocedal and Wright 2006, section 3.1)
constexpr double shortest_move = 1e-10;       // least step length along a direction
constexpr int patience = 20;                  // iterations without progress once rounding hides the error
constexpr double newton_error_ratio = 2;      // largest ratio of the distance from the minimum to the Newton step

}  // namespace

Minimiser::Minimiser(const System& system, const StepObjective& objective, const IntegratorSettings& settings,
                     int default_max_iterations)
    : system_(system),
      objective_(objective),
      stop_(system.stop),
      accuracy_(settings, system, objective.inertia()),
      tolerance_(accuracy_.tolerance),
      max_iterations_(settings.max_iterations.value_or(default_max_iterations)) {
  trial_.gradient = trial_.x = Vertices::Zero(objective.y().rows(), 3);
}

ConstantFactor& Minimiser::constant_factor() {
  if (!factor_) factor_ = std::make_unique<ConstantFactor>(system_, objective_.duration(), Precision::automatic);
  return *factor_;
}

StepReport Minimiser::minimise(Iterate& point, const std::function<bool()>& may_end) {
  start();
  StepReport report;
  if (std::isnan(point.value)) {
    report.converged = false;  // from non-finite forces: iterations are useless
    return report;
  }
  double change = std::numeric_limits<double>::infinity();
  least_error_ = newton_error_ = change;
  iterations_without_progress_ = 0;
  for (; report.iterations < max_iterations_; ++report.iterations) {
    if (balanced(point, change)) return report;
    stop_.check();
    const double before = point.value;
    change = iterate(point);
    if (point.value > before) {
      report.rise = std::max(report.rise, point.value - (before + objective_.rounding(before)));
    }
    const bool settled =
        accuracy_.rule == StoppingRule::change && report.iterations >= 1 && change < accuracy_.tolerance;
    if (settled && may_end()) {
      ++report.iterations;
      return report;
    }
    // A failed line search has reached the minimum up to rounding and would fail again.
    if (accuracy_.rule == StoppingRule::error && change == 0) break;
  }
  report.converged = balanced(point, change);
  return report;
}

bool Minimiser::balanced(const Iterate& point, double change) {
  switch (accuracy_.rule) {
    case StoppingRule::change:
      return false;  // a small change does not prove convergence, so extra iterations are granted
    case StoppingRule::gradient:
      return norm(objective_.threads(), point.gradient) < accuracy_.tolerance;
    case StoppingRule::error:
      break;
  }
  const double error = objective_.error_bound(point.gradient);
  tolerance_ = accuracy_.tolerance_at(objective_, point.x, start_error_);
  if (std::min(error, newton_error_) <= tolerance_) return true;
  // If rounding hides the error, small iterations or no progress end the minimisation.
  iterations_without_progress_ = error < least_error_ ? 0 : iterations_without_progress_ + 1;
  least_error_ = std::min(least_error_, error);
  return (change <= tolerance_ || iterations_without_progress_ >= patience) && error <= objective_.error_rounding();
}

double Minimiser::error(const Iterate& point) {
  const double bound = objective_.error_bound(point.gradient), known = std::min(bound, newton_error_);
  if (accuracy_.rule == StoppingRule::error && known <= tolerance_) return known;
  find_newton_step(point, trial_.x);
  return std::min(bound, trial_.x.rowwise().norm().maxCoeff());
}

void Minimiser::note_newton_step(const Vertices& newton_step) {
  newton_error_ = newton_error_ratio * newton_step.rowwise().norm().maxCoeff();
}

double Minimiser::descend(Iterate& point, const Vertices& direction, double slope) {
  for (double length = 1; length >= shortest_move; length /= 2) {
    if (length < 1) stop_.check();
    sum(objective_.threads(), point.x, -length, direction, trial_.x);
    trial_.value = objective_.evaluate(trial_.x, trial_.gradient);
    // Near the minimum the decrease of g is below rounding; accept the direction there.
    const double highest = point.value - sufficient_decrease * length * slope + objective_.rounding(point.value);
    if (trial_.value <= highest) {
      std::swap(point, trial_);
      return length;
    }
  }
  return 0;
}

}  // namespace drape
