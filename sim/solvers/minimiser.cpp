#include "sim/solvers/minimiser.hpp"

#include <algorithm>
#include <utility>

namespace drape {
namespace {

constexpr double sufficient_decrease = 1e-4;  // Armijo's constant, as usual (Nocedal and Wright 2006, section 3.1)
constexpr double shortest_move = 1e-10;       // of a direction

}  // namespace

Minimiser::Minimiser(const StepObjective& objective, const IntegratorSettings& settings, int default_max_iterations)
    : objective_(objective),
      stop_(settings.stop),
      tolerance_(settings.tolerance),
      max_iterations_(settings.max_iterations.value_or(default_max_iterations)) {
  trial_.gradient = trial_.x = Vertices::Zero(objective.y().rows(), 3);
}

StepReport Minimiser::minimise(Point& point, const std::function<bool()>& may_end) {
  start();
  StepReport report;
  // Who asks for a gradient gets it; a change says little about how far the minimum is.
  const auto balanced = [&] { return stop_ == StoppingRule::gradient && norm(point.gradient) < tolerance_; };
  for (; report.iterations < max_iterations_; ++report.iterations) {
    if (balanced()) return report;
    const double before = point.value;
    const double change = iterate(point);
    if (point.value > before) {
      report.rise = std::max(report.rise, point.value - before - objective_.rounding(before));
    }
    const bool settled = stop_ == StoppingRule::change && report.iterations >= 1 && change < tolerance_;
    if (settled && may_end()) {
      ++report.iterations;
      return report;
    }
  }
  report.converged = balanced();
  return report;
}

double Minimiser::descend(Point& point, const Vertices& direction, double slope) {
  const auto count = static_cast<std::size_t>(point.x.size());
  for (double length = 1; length >= shortest_move; length /= 2) {
    trial_.x = point.x;
    kernels().add_multiple(count, -length, direction.data(), trial_.x.data());
    trial_.value = objective_.evaluate(trial_.x, trial_.gradient);
    // Near the minimum g changes by less than it can be computed to; the direction is trusted there.
    const double highest = point.value - sufficient_decrease * length * slope + objective_.rounding(point.value);
    if (trial_.value <= highest) {
      std::swap(point, trial_);
      return length;
    }
  }
  return 0;
}

}  // namespace drape
