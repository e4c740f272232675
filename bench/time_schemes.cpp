#include "bench/ratio_table.hpp"

#include <fmt/format.h>
#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "bench/moving_cloth.hpp"
#include "bench/textbook.hpp"
#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/damping.hpp"
#include "drape/sim/effects/sphere.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/linear/multifrontal_cholesky.hpp"
#include "sim/linear/sparse_cholesky.hpp"

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

/// A motion of so many steps.
Subject simulated(SimulationSettings settings, int steps) {
  const auto simulation = std::make_shared<Simulation>(std::move(settings));
  return {.restore = [simulation, start = simulation->state()] { simulation->restore(start); },
          .run =
              [simulation, steps] {
                for (int step = 0; step < steps; ++step) simulation->step();
                return 1;  // motion
              }};
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
  return simulated(std::move(settings), how.steps);
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

namespace {

/// The falling cloth of scene 3, to an error: by the default method, in substeps of h, and by XPBD in enough steps.
struct Peer {
  std::string name;
  int cells, xpbd_steps;
};

constexpr double step = 0.02;  // h [s]

Cloth hanging_cloth(int cells) {
  const Mesh mesh = make_grid(cells, cells);
  return make_cloth(mesh, mesh, 1, 180, {0, cells});
}

Subject make_by_default(const Peer& peer) {
  SimulationSettings settings;
  settings.cloth = hanging_cloth(peer.cells);
  settings.step = step;
  settings.effects = {Gravity{}};
  return simulated(std::move(settings), static_cast<int>(std::lround(duration / step)));
}

Subject make_by_xpbd(const Peer& peer) {
  const Cloth cloth = hanging_cloth(peer.cells);
  const auto xpbd = std::make_shared<textbook::Xpbd>(cloth, textbook::Settings{.step = duration / peer.xpbd_steps});
  return {.restore =
              [xpbd, cloth] {
                xpbd->positions = cloth.positions;
                xpbd->velocities = cloth.velocities;
              },
          .run =
              [xpbd, steps = peer.xpbd_steps] {
                for (int i = 0; i < steps; ++i) xpbd->step();
                return 1;  // motion
              }};
}

}  // namespace

std::vector<std::string> register_peers() {
  const std::vector<Peer> peers{{"scene_3_within_1_cm/20", 20, 650},
                                {"scene_3_within_1_mm/20", 20, 4000},
                                {"scene_3_within_1_cm/100", 100, 2800}};
  std::vector<std::string> names;
  for (const Peer& peer : peers) {
    register_subject(peer.name, "drape", 1, [peer] { return make_by_default(peer); });
    register_subject(peer.name, "xpbd", 1, [peer] { return make_by_xpbd(peer); });
    names.push_back(peer.name);
  }
  return names;
}

namespace {

constexpr int grid_cells = 20;
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
  const Cloth cloth = make_resting_cloth(grid_cells);
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
      textbook::make_newton(make_resting_cloth(grid_cells), textbook_settings(c));
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
    settings.cloth = make_resting_cloth(grid_cells);
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

namespace {

/// M/h² + L of a cloth without pins, h = 0.02 s.
struct ClothMatrix {
  Cloth cloth;
  LowerPattern pattern;
  std::vector<double> values;

  explicit ClothMatrix(int cells) : cloth(make_resting_cloth(cells)) {
    cloth.pins.clear();
    pattern = spring_pattern({.springs = cloth.springs}, FreeVertices(cloth));
    values.assign(pattern.rows.size(), -cloth.springs.front().stiffness);
    std::vector<double> diagonal(static_cast<std::size_t>(cloth.vertex_count()), cloth.masses[0] / 4e-4);
    for (const Spring& s : cloth.springs) {
      for (const int end : {s.i, s.j}) diagonal[static_cast<std::size_t>(end)] += s.stiffness;
    }
    for (std::size_t v = 0; v < diagonal.size(); ++v) values[static_cast<std::size_t>(pattern.starts[v])] = diagonal[v];
  }
};

Subject make_fronts(int cells) {
  const auto matrix = std::make_shared<ClothMatrix>(cells);
  return {.restore = [] {},
          .run =
              [matrix] {
                MultifrontalCholesky factor(matrix->pattern, dissect(matrix->pattern, matrix->cloth.rest));
                return factor.factorize(matrix->values.data()) ? 1 : 0;
              }};
}

Subject make_cholmod(int cells) {
  const auto matrix = std::make_shared<ClothMatrix>(cells);
  return {.restore = [] {},
          .run =
              [matrix] {
                SparseCholesky factor(matrix->pattern);
                return factor.factorize(matrix->values.data()) ? 1 : 0;
              }};
}

/// CHOLMOD's supernodal factor, on the BLAS that the system has.
Subject make_supernodal(int cells) {
  const ClothMatrix made(cells);
  const auto matrix = std::make_shared<Eigen::SparseMatrix<double>>(Eigen::Map<const Eigen::SparseMatrix<double>>(
      made.pattern.size(), made.pattern.size(), made.pattern.entries(), made.pattern.starts.data(),
      made.pattern.rows.data(), made.values.data()));
  return {.restore = [] {},
          .run =
              [matrix] {
                const Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor(*matrix);
                return factor.info() == Eigen::Success ? 1 : 0;
              }};
}

/// Registers the fronts beside another factor of the same matrices.
std::vector<std::string> register_factoring(const std::string& name, const std::string& other, Subject (*make)(int)) {
  std::vector<std::string> names;
  for (const int cells : {100, 300}) {
    names.push_back(fmt::format("{}/{}", name, cells));
    register_subject(names.back(), "fronts", 1, [cells] { return make_fronts(cells); });
    register_subject(names.back(), other, 1, [make, cells] { return make(cells); });
  }
  return names;
}

}  // namespace

std::vector<std::string> register_factoring() { return register_factoring("factor", "cholmod", make_cholmod); }

std::vector<std::string> register_supernodal_factoring() {
  return register_factoring("supernodal_factor", "supernodal", make_supernodal);
}

}  // namespace drape
