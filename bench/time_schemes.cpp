#include "bench/time_schemes.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include "bench/subject.hpp"
#include "sim/effects/damping.hpp"
#include "sim/effects/gravity.hpp"
#include "sim/simulation.hpp"

namespace drape {
namespace {

constexpr double duration = 0.42;  // from rest [s]

/// A method with the longest step and the loosest tolerance that keep the requested error.
struct Integration {
  StepMethod method;
  int steps;               ///< of the whole motion
  double tolerance = 0.1;  ///< [m]
};

struct EqualError {
  std::string name;
  double stiffness, damping;
  Integration second_order, first_order;
};

/// Methods of equal error, taken over all vertices at the end; tests/physics/order_test.cpp verifies the errors.
const std::vector<EqualError>& equal_errors() {
  static const std::vector<EqualError> all{
      {"scene_3_to_1_mm", 180, 1, {{Method::quasi_newton, TimeScheme::sdirk2}, 168, 1e-5}, {Method::liu13, 3500}},
      {"scene_1_to_1_mm", 18, 0.2, {Method::verlet, 70}, {Method::semi_implicit, 420}},
      {"scene_1_to_0.1_mm", 18, 0.2, {Method::verlet, 220}, {Method::semi_implicit, 4200}},
  };
  return all;
}

Subject make_motion(const EqualError& c, const Integration& how) {
  const Mesh mesh = make_grid(20, 20);
  SimulationSettings settings;
  settings.cloth = make_cloth(mesh, mesh, 1, c.stiffness, {0, 20});
  settings.step = duration / how.steps;
  settings.integrator.method = how.method.method;
  settings.integrator.scheme = how.method.scheme;
  settings.integrator.stop = StoppingRule::change;
  settings.integrator.tolerance = how.tolerance;
  settings.effects = {Gravity{}};
  if (c.damping < 1) settings.effects.add(Damping{.factor = c.damping});
  const auto simulation = std::make_shared<Simulation>(std::move(settings));
  return {.restore = [simulation, start = simulation->state()] { simulation->restore(start); },
          .run =
              [simulation, steps = how.steps] {
                for (int step = 0; step < steps; ++step) simulation->step();
                return 1;  // motion
              }};
}

}  // namespace

std::vector<std::string> register_time_schemes() {
  std::vector<std::string> names;
  for (const EqualError& c : equal_errors()) {
    register_subject(c.name, "second order", 1, [c] { return make_motion(c, c.second_order); });
    register_subject(c.name, "first order", 1, [c] { return make_motion(c, c.first_order); });
    names.push_back(c.name);
  }
  return names;
}

}  // namespace drape
