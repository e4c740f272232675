#include "study/reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "drape/core/error.hpp"
#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/effects/sphere.hpp"
#include "drape/sim/effects/strain_limit.hpp"
#include "run/run_scene.hpp"
#include "sim/step_objective.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

// Close to buckling Newton's matrix is nearly singular, and even Newton's method needs thousands of iterations.
constexpr int most_iterations = 5000;

constexpr std::array<std::string_view, 4> sudden_effects{Sphere::name, Ground::name, SelfCollision::name,
                                                         StrainLimit::name};

}  // namespace

Distance distance(const Vertices& a, const Vertices& b) {
  const Eigen::VectorXd squares = (a - b).rowwise().squaredNorm();
  return {std::sqrt(squares.maxCoeff()), std::sqrt(squares.mean())};
}

SimulationSettings to_rounding(SimulationSettings settings, Method method) {
  const System system = make_system(settings);
  const Cloth& cloth = settings.cloth;
  const StiffnessBound bound = system.stiffness_bound();
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(cloth.vertex_count());
  bound.for_each_pair([&](const Spring& spring) {
    stiffness[spring.i] += std::abs(spring.stiffness);
    stiffness[spring.j] += std::abs(spring.stiffness);
  });
  stiffness += bound.vertices;
  const double h = settings.step;
  const double amplified = 1 + h * h * (stiffness.array() / cloth.masses.array()).maxCoeff();
  const double unit = std::numeric_limits<double>::epsilon() * cloth.positions.cwiseAbs().maxCoeff();
  settings.integrator.method = method;
  settings.integrator.stop = StoppingRule::change;
  settings.integrator.tolerance = unit * std::sqrt(3.0 * cloth.vertex_count()) * amplified;
  settings.integrator.max_iterations = most_iterations;
  return settings;
}

std::optional<std::int64_t> ReferenceMotion::first_beyond(double limit) const {
  const auto found = std::find_if(apart.begin(), apart.end(), [limit](double d) { return d > limit; });
  if (found == apart.end()) return std::nullopt;
  return found - apart.begin() + 1;
}

std::optional<ReferenceMotion> run_reference(const SimulationSettings& settings, std::int64_t steps,
                                             const std::vector<std::int64_t>& keep, const std::stop_token& stop,
                                             Progress& progress) {
  progress.begin("computing the reference", "steps", steps);
  Simulation newton(to_rounding(settings, Method::implicit));
  Simulation quasi_newton(to_rounding(settings, Method::quasi_newton));
  ReferenceMotion motion;
  auto next = keep.begin();
  const auto look = [&] {
    for (; next != keep.end() && *next == newton.state().step; ++next) motion.states.push_back(newton.state());
  };
  look();
  run_steps(newton, steps, stop, [&](const StepReport&) {
    quasi_newton.step();
    motion.apart.push_back(distance(newton.state().x, quasi_newton.state().x).max);
    look();
    ++progress.done;
  });
  if (stop.stop_requested()) return std::nullopt;
  return motion;
}

std::optional<std::int64_t> first_contact(const SimulationSettings& settings, std::int64_t steps, double limit,
                                          const std::stop_token& stop) {
  SimulationSettings untouched = settings;
  untouched.effects = {};
  for (const Effect& effect : settings.effects) {
    if (std::ranges::find(sudden_effects, effect.name()) == sudden_effects.end()) untouched.effects.add(effect);
  }
  if (untouched.effects.size() == settings.effects.size()) return std::nullopt;
  Simulation with(to_rounding(settings, Method::implicit)), without(to_rounding(untouched, Method::implicit));
  while (with.state().step < steps && !stop.stop_requested()) {
    with.step();
    without.step();
    if (distance(with.state().x, without.state().x).max > limit) return with.state().step;
  }
  return std::nullopt;
}

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
