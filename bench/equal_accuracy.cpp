#include "bench/equal_accuracy.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "bench/moving_cloth.hpp"
#include "bench/subject.hpp"
#include "bench/textbook.hpp"
#include "sim/effects/gravity.hpp"
#include "sim/effects/sphere.hpp"
#include "sim/simulation.hpp"

namespace drape {
namespace {

constexpr int cells = 20;
constexpr double step = 0.02;  // h [s]
// Steps of the textbook's motion from rest. Over the sphere, the cloth touches it from the first of them on.
constexpr int first_step = 30, last_step = 130, every = 5;
constexpr int measured_steps = (last_step - first_step) / every;

struct Comparison {
  std::string name;
  double tolerance;  ///< the textbook's ε [m]
  bool sphere;
};

/// Initial states of the textbook's steps, and the residuals that they reach.
struct Reference {
  std::vector<State> states;
  std::vector<double> residuals;  ///< ‖∇g‖ [N]
};

textbook::Settings textbook_settings(const Comparison& c) {
  textbook::Settings settings;
  settings.step = step;
  settings.tolerance = c.tolerance;
  if (c.sphere) settings.sphere = textbook::Sphere{};
  return settings;
}

Reference make_reference(const Comparison& c) {
  const Cloth cloth = make_resting_cloth(cells);
  const textbook::Settings settings = textbook_settings(c);
  const auto stepper = textbook::make_newton(cloth, settings);
  stepper->positions = cloth.positions;
  stepper->velocities = cloth.velocities;
  Reference reference;
  for (int i = 0; i < last_step; ++i) {
    const State before{.x = stepper->positions, .v = stepper->velocities, .step = 0};
    stepper->step();
    if (i < first_step || i % every != 0) continue;
    reference.states.push_back(before);
    reference.residuals.push_back(textbook::gradient_norm(cloth, settings, *stepper));
  }
  return reference;
}

Subject make_textbook(const Comparison& c) {
  const auto reference = std::make_shared<Reference>(make_reference(c));
  const std::shared_ptr<textbook::Stepper> stepper =
      textbook::make_newton(make_resting_cloth(cells), textbook_settings(c));
  return {.restore = [] {},
          .run =
              [=] {
                for (const State& state : reference->states) {
                  stepper->positions = state.x;
                  stepper->velocities = state.v;
                  stepper->step();
                }
                return measured_steps;
              }};
}

Sphere textbook_sphere() {
  const textbook::Sphere sphere;
  return {.center = sphere.center, .radius = sphere.radius, .scale = sphere.scale, .stiffness = sphere.stiffness};
}

/// Makes one simulation per step, because each step has its own target residual.
Subject make_drape(const Comparison& c) {
  const auto reference = std::make_shared<Reference>(make_reference(c));
  const auto simulations = std::make_shared<std::vector<std::unique_ptr<Simulation>>>();
  for (const double residual : reference->residuals) {
    SimulationSettings settings;
    settings.cloth = make_resting_cloth(cells);
    settings.step = step;
    settings.integrator.method = Method::quasi_newton;
    settings.integrator.stop = StoppingRule::gradient;
    settings.integrator.tolerance = residual;
    settings.effects = {Gravity{}};
    if (c.sphere) settings.effects.add(textbook_sphere());
    simulations->push_back(std::make_unique<Simulation>(std::move(settings)));
  }
  return {.restore =
              [=] {
                for (std::size_t i = 0; i < simulations->size(); ++i) (*simulations)[i]->restore(reference->states[i]);
              },
          .run =
              [=] {
                int converged = 0;
                for (const auto& simulation : *simulations) converged += simulation->step().converged ? 1 : 0;
                return converged;
              }};
}

}  // namespace

std::vector<std::string> register_equal_accuracy() {
  std::vector<std::string> names;
  for (const Comparison& c : {Comparison{"step_as_accurate_as_newton/1e-3", 1e-3, false},
                              Comparison{"step_as_accurate_as_newton/1e-5", 1e-5, false},
                              Comparison{"step_as_accurate_as_newton/1e-5_sphere", 1e-5, true}}) {
    register_subject(c.name, "drape", measured_steps, [c] { return make_drape(c); });
    register_subject(c.name, "textbook", measured_steps, [c] { return make_textbook(c); });
    names.push_back(c.name);
  }
  return names;
}

}  // namespace drape
