#include "study/reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "run/run_steps.hpp"
#include "sim/effects/ground.hpp"
#include "sim/effects/self_collision.hpp"
#include "sim/effects/sphere.hpp"
#include "sim/effects/strain_limit.hpp"
#include "sim/make_system.hpp"

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

}  // namespace drape
