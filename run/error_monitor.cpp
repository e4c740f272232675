#include "run/error_monitor.hpp"

#include <algorithm>

namespace drape {
namespace {

constexpr std::int64_t between_looks = 128;  // steps between two estimates
constexpr double coarse_share = 0.01;        // share of the cloth's size
constexpr double still = 1e-3;               // speed below which a cloth is at rest [cloth sizes/s]
constexpr double moment = 0.01;              // or the speed that residual_force forces cause within this time [s]

}  // namespace

void ErrorMonitor::begin(const Simulation& simulation) {
  accuracy_ = simulation.accuracy();
  asked_ = simulation.settings().accuracy;
  size_ = size_of(simulation.cloth());
}

void ErrorMonitor::after_step(const Simulation& simulation, const StepReport& report, double /*seconds*/) {
  if (report.estimate) return note(simulation.state().step, *report.estimate);
  if (!accuracy_) return;
  const bool known = accuracy_->rule == StoppingRule::error && report.converged;
  if (known || simulation.state().step % between_looks == 0) look(simulation);
}

void ErrorMonitor::replay(const StepRow& row, double /*time*/, double /*seconds*/) {
  if (row.error) note(row.step, *row.error);
}

void ErrorMonitor::look(const Simulation& simulation) { note(simulation.state().step, simulation.error()); }

void ErrorMonitor::note(std::int64_t step, double error) {
  sum_ += error;
  largest_ = std::max(largest_, error);
  last_ = step;
  last_error_ = error;
  ++looked_at_;
}

void ErrorMonitor::finish(const Simulation& simulation) {
  const State& state = simulation.state();
  if (!accuracy_ || state.step == 0) return;
  if (last_ != state.step) look(simulation);
  const double force = simulation.residual_force();
  const double standing = std::max(still * size_, moment * force / simulation.cloth().masses.sum());
  if (!(state.v.rowwise().norm().maxCoeff() <= standing)) return;
  const double weight = simulation.weight();
  residual_force_ = {.force = force, .of_weight = weight > 0 ? std::optional(force / weight) : std::nullopt};
}

std::optional<ErrorMonitor::Errors> ErrorMonitor::errors() const {
  if (looked_at_ == 0) return std::nullopt;
  return Errors{.mean = sum_ / static_cast<double>(looked_at_), .largest = largest_};
}

bool ErrorMonitor::coarse() const {
  const auto found = errors();
  return found && found->mean > coarse_share * size_;
}

}  // namespace drape
