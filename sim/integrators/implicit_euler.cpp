#include "sim/integrators/implicit_euler.hpp"

namespace drape {

ImplicitEuler::ImplicitEuler(const System& system, const IntegratorSettings& settings, int default_max_iterations)
    : system_(system),
      stop_(settings.stop),
      tolerance_(settings.tolerance),
      max_iterations_(settings.max_iterations.value_or(default_max_iterations)),
      objective_(system),
      x_(system.cloth.positions),
      gradient_(Vertices::Zero(x_.rows(), 3)) {}

StepReport ImplicitEuler::advance(State& state, const Vertices& force) {
  objective_.begin(state, force);
  x_ = objective_.y();
  const StepReport report = minimise();
  state.v = (x_ - state.x) / system_.step;
  state.x = x_;
  system_.correct(state);
  return report;
}

StepReport ImplicitEuler::minimise() {
  for (int iteration = 1; iteration <= max_iterations_; ++iteration) {
    objective_.gradient(x_, gradient_);
    if (stop_ == StoppingRule::gradient && gradient_.norm() < tolerance_) return {iteration - 1, true};
    const double change = iterate(x_, gradient_);
    if (stop_ == StoppingRule::change && iteration >= 2 && change < tolerance_) return {iteration, true};
  }
  return {max_iterations_, stop_ == StoppingRule::gradient && residual() < tolerance_};
}

double ImplicitEuler::residual() {
  objective_.gradient(x_, gradient_);
  return gradient_.norm();
}

}  // namespace drape
