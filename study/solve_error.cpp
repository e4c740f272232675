#include "study/solve_error.hpp"

#include <algorithm>

#include "sim/make_system.hpp"
#include "sim/step_objective.hpp"
#include "study/reference.hpp"

namespace drape {
namespace {

/// Returns ‖∇g(y)‖ [N] of the step that begins in a state.
double first_gradient(const System& system, StepObjective& objective, const State& state) {
  const double time = static_cast<double>(state.step) * system.step;
  Vertices force = Vertices::Zero(state.x.rows(), 3), gradient = force;
  for (const auto& one : system.forces) one->add(state, time, force);
  for (const auto& one : system.fields) one->add(state, time, force);
  objective.begin(state.x, state.v, force, system.time(state.step + 1));
  objective.evaluate(objective.y(), gradient);
  return gradient.norm();
}

}  // namespace

ExactSteps::ExactSteps(const SimulationSettings& settings, const std::vector<State>& states, double limit)
    : settings_(settings) {
  Simulation newton(to_rounding(settings, Method::implicit));
  Simulation quasi_newton(to_rounding(settings, Method::quasi_newton));
  const System system = make_system(settings_);
  StepObjective objective(system, system.step);
  for (const State& state : states) {
    for (Simulation* simulation : {&newton, &quasi_newton}) {
      simulation->restore(state);
      simulation->step();
    }
    const double apart = distance(newton.state().x, quasi_newton.state().x).max;
    if (apart > limit) {
      ++left_out_;
      continue;
    }
    apart_ = std::max(apart_, apart);
    states_.push_back(state);
    minimisers_.push_back(newton.state().x);
    first_gradients_.push_back(first_gradient(system, objective, state));
  }
}

SolveError ExactSteps::error(const IntegratorSettings& integrator) const {
  SimulationSettings settings = settings_;
  settings.integrator = integrator;
  Simulation simulation(settings);
  SolveError sum;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    simulation.restore(states_[i]);
    simulation.step();
    const Distance d = distance(simulation.state().x, minimisers_[i]);
    sum.max += d.max;
    sum.rms += d.rms;
    sum.gradient += simulation.residual() / first_gradients_[i];
  }
  const auto n = static_cast<double>(states_.size());
  return {sum.max / n, sum.rms / n, sum.gradient / n};
}

}  // namespace drape
