#include "study/solve_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "drape/core/error.hpp"
#include "run/run_scene.hpp"
#include "sim/step_objective.hpp"
#include "sim/system.hpp"
#include "study/reference.hpp"

namespace drape {
namespace {

constexpr int explicit_halvings = 9, implicit_halvings = 7;

}  // namespace

LocalErrors::LocalErrors(const SimulationSettings& settings) {
  SimulationSettings small = settings;
  small.accuracy.reset();
  small.integrator = {};
  small.integrator.method = Method::verlet;
  halvings_ = explicit_halvings;
  try {
    make(small, settings.step);
  } catch (const UsageError&) {
    halvings_ = implicit_halvings;
    small.integrator.scheme = TimeScheme::sdirk2;
    small.step = std::ldexp(settings.step, -halvings_);
    make(to_rounding(small, Method::quasi_newton), settings.step);
  }
}

void LocalErrors::make(SimulationSettings small, double step) {
  small.step = std::ldexp(step, 1 - halvings_);
  twice_.emplace(small);
  small.step = std::ldexp(step, -halvings_);
  small_.emplace(small);
}

Vertices LocalErrors::small_steps(Simulation& simulation, int halvings, State from) {
  from.step <<= halvings;
  const std::int64_t end = from.step + (std::int64_t{1} << halvings);
  simulation.restore(from);
  while (simulation.state().step < end) simulation.step();
  return simulation.state().x;
}

std::optional<LocalErrors::LocalError> LocalErrors::of_step(const State& before, const Vertices& after) {
  try {
    const Vertices plain = small_steps(*small_, halvings_, before),
                   coarse = small_steps(*twice_, halvings_ - 1, before);
    const Vertices exact = (4 * plain - coarse) / 3;
    return LocalError{distance(after, exact).max, distance(plain, exact).max};
  } catch (const DivergedError&) {
    return std::nullopt;
  }
}

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

namespace {

constexpr std::int64_t refinement = 2, most_refinement = 16;  // factor for cheap Verlet steps; its limit for stability
constexpr int most_halvings_of_verlet = 3;

/// Returns the Richardson extrapolation of two step lengths, `coarse` twice `fine`.
Vertices extrapolated(const Vertices& fine, const Vertices& coarse) { return (4 * fine - coarse) / 3; }

/// A second-order motion in small steps.
class SmallSteps {
 public:
  SmallSteps(SimulationSettings settings, const std::vector<std::int64_t>& moments, std::int64_t parts)
      : settings_(std::move(settings)), moments_(moments), whole_(settings_.step), parts_(parts) {
    settings_.accuracy.reset();
    settings_.integrator = {};
    settings_.integrator.method = Method::verlet;
    for (parts_ = refinement * parts; parts_ <= most_refinement * parts; parts_ *= 2) {
      if (can_run(parts_ / 4)) return;
    }
    parts_ = parts;
    settings_.integrator.method = Method::quasi_newton;
    settings_.integrator.scheme = TimeScheme::sdirk2;
  }

  /// Returns the number of steps per step of the scene.
  [[nodiscard]] std::int64_t parts() const { return parts_; }
  /// Returns the step length for a number of parts [s].
  [[nodiscard]] double length(std::int64_t parts) const { return whole_ / static_cast<double>(parts); }
  [[nodiscard]] int most_halvings() const { return solved() ? 0 : most_halvings_of_verlet; }

  /// Returns the positions at the moments; nothing if stopped.
  [[nodiscard]] std::optional<std::vector<Vertices>> run(std::int64_t parts, const std::stop_token& stop,
                                                         Progress& progress) const {
    progress.begin("computing the reference in small steps", "steps", parts * moments_.back());
    Simulation simulation(with(parts));
    std::vector<Vertices> places;
    for (const std::int64_t moment : moments_) {
      StepCounter counter(progress);
      run_steps(simulation, parts * moment, std::array<StepObserver*, 1>{&counter}, stop);
      if (stop.stop_requested()) return std::nullopt;
      places.push_back(simulation.state().x);
    }
    return places;
  }

 private:
  [[nodiscard]] bool solved() const { return settings_.integrator.method != Method::verlet; }

  [[nodiscard]] SimulationSettings with(std::int64_t parts) const {
    SimulationSettings settings = settings_;
    settings.step = length(parts);
    return solved() ? to_rounding(settings, settings.integrator.method) : settings;
  }

  [[nodiscard]] bool can_run(std::int64_t parts) const {
    try {
      const Simulation simulation(with(parts));
      return true;
    } catch (const UsageError&) {
      return false;
    }
  }

  SimulationSettings settings_;
  const std::vector<std::int64_t> moments_;
  double whole_;  // [s]
  std::int64_t parts_;
};

}  // namespace

std::optional<std::size_t> StepReference::place(std::int64_t moment) const {
  const auto found = std::ranges::lower_bound(moments, moment);
  if (found == moments.end() || *found != moment) return std::nullopt;
  return static_cast<std::size_t>(found - moments.begin());
}

double StepReference::gained(std::size_t place) const { return distance(plain[place], x[place]).max; }

std::optional<StepReference> extrapolate_steps(SimulationSettings settings, std::vector<std::int64_t> moments,
                                               std::int64_t parts, double wanted, const std::stop_token& stop,
                                               Progress& progress) {
  const SmallSteps steps(std::move(settings), moments, parts);
  StepReference reference;
  reference.moments = std::move(moments);
  parts = steps.parts();
  auto coarser = steps.run(parts / 4, stop, progress), coarse = steps.run(parts / 2, stop, progress),
       fine = steps.run(parts, stop, progress);
  for (int halvings = 0;; ++halvings) {
    if (!coarser || !coarse || !fine) return std::nullopt;
    reference.x.clear();
    for (std::size_t i = 0; i < fine->size(); ++i) reference.x.push_back(extrapolated((*fine)[i], (*coarse)[i]));
    reference.apart = distance(extrapolated(coarse->front(), coarser->front()), reference.x.front()).max;
    const double gained = distance(fine->front(), reference.x.front()).max,
                 before = distance(coarse->front(), coarser->front()).max / 3;
    if (gained <= wanted || gained > before / 2 || halvings == steps.most_halvings()) break;
    coarser = std::move(coarse);
    coarse = std::move(fine);
    fine = steps.run(parts *= 2, stop, progress);
  }
  reference.plain = std::move(*fine);
  reference.step = steps.length(parts);
  return reference;
}

}  // namespace drape
