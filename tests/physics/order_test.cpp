// Order of convergence: measured between the two smallest steps, on known motions.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "bench/textbook.hpp"
#include "drape/sim/effects/air.hpp"
#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/moving_pins.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/physics/contact_settings.hpp"
#include "tests/support/plain_springs.hpp"

namespace drape::test {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

/// Solves so tightly that only the error of the time step remains.
void solve_tightly(SimulationSettings& settings) {
  settings.integrator.stop = StoppingRule::change;
  settings.integrator.tolerance = 1e-11;
  settings.integrator.max_iterations = 5000;
}

State run(SimulationSettings settings, double duration, int steps) {
  solve_tightly(settings);
  settings.step = duration / steps;
  Simulation simulation(settings);
  for (int step = 0; step < steps; ++step) simulation.step();
  return simulation.state();
}

/// Orders of the largest errors of a vertex's position and velocity.
struct Orders {
  double positions, velocities;
};
double largest(const Vertices& a, const Vertices& b) { return (a - b).rowwise().norm().maxCoeff(); }

/// Returns the orders between `steps` and twice as many.
Orders orders(const SimulationSettings& settings, const State& exact, double duration, int steps) {
  const State coarse = run(settings, duration, steps), fine = run(settings, duration, 2 * steps);
  return {std::log2(largest(coarse.x, exact.x) / largest(fine.x, exact.x)),
          std::log2(largest(coarse.v, exact.v) / largest(fine.v, exact.v))};
}

void expect_second(const Orders& found, double at_least = 1.8) {
  EXPECT_GE(found.positions, at_least) << "of the positions";
  EXPECT_GE(found.velocities, at_least) << "of the velocities";
}

class SecondOrder : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, SecondOrder, testing::ValuesIn(second_order_methods), method_name);

// From rest at its rest length, a spring extends by mg/k·(1 − cos ωt), ω² = k/m.
TEST_P(SecondOrder, HoldsForASpringThatSwingsUnderItsWeight) {
  constexpr double mass = 0.1, stiffness = 50, duration = 1, g = 9.8;
  Cloth cloth;
  cloth.positions = Vertices::Zero(2, 3);
  cloth.positions(1, 2) = -0.25;
  cloth.velocities = Vertices::Zero(2, 3);
  cloth.masses.setConstant(2, mass);
  cloth.springs = {{.i = 0, .j = 1, .rest_length = 0.25, .stiffness = stiffness}};
  cloth.pins = {0};
  SimulationSettings settings = setup(cloth, GetParam(), 1);
  settings.effects = {Gravity{}};
  const double frequency = std::sqrt(stiffness / mass), stretch = mass * g / stiffness;
  State exact{.x = cloth.positions, .v = cloth.velocities};
  exact.x(1, 2) -= stretch * (1 - std::cos(frequency * duration));
  exact.v(1, 2) = -stretch * frequency * std::sin(frequency * duration);
  expect_second(orders(settings, exact, duration, 400));
}

/// Makes a cloth that hangs from its upper edge, turned about it by half a radian, without strain.
SimulationSettings pendulum(Solver solver) {
  const Mesh rest = make_grid(4, 4);
  Mesh start = rest;
  for (int i = 0; i < start.positions.rows(); ++i) {
    const double below = 1 - rest.positions(i, 1);
    start.positions.row(i) << rest.positions(i, 0), below * std::sin(0.5), -below * std::cos(0.5);
  }
  SimulationSettings settings = setup(make_cloth(start, rest, 1, 100, {20, 21, 22, 23, 24}), solver, 1);
  settings.effects = {Gravity{}, Damping{.factor = 0.5}};
  return settings;
}

TEST_P(SecondOrder, HoldsForAClothThatSwingsAsAPendulum) {
  constexpr double duration = 0.8;
  const SimulationSettings settings = pendulum(GetParam());
  const State exact = exact_motion(settings.cloth, Vector3d(0, 0, -9.8), 0.5, duration, 4000);
  expect_second(orders(settings, exact, duration, 400));
}

/// Expects second order beside a motion in 10 000 steps of velocity Verlet.
void expect_second_beside_verlet(const SimulationSettings& settings) {
  constexpr double duration = 0.8;
  SimulationSettings fine = settings;
  fine.integrator.method = Method::verlet;
  const State exact = run(fine, duration, 10'000);
  expect_second(orders(settings, exact, duration, 400));
}

/// Moves the pins of pendulum().
drape::MovingPins smooth_pins() {
  return {.pins = {20, 21, 22, 23, 24},
          .keyframes = {{0, {0, 0, 0}}, {1, {0.2, 0.4, 0.3}}},
          .interpolation = Interpolation::smooth};
}

// Air drag grows with the square of the speed, and bends a cloth that swings back.
TEST_P(SecondOrder, HoldsForAir) {
  SimulationSettings settings = pendulum(GetParam());
  settings.effects.add(drape::Air{.velocity = {0.3, -4, 0}, .gusts = {.speed = 0.5}});
  expect_second_beside_verlet(settings);
}

TEST_P(SecondOrder, HoldsForPinsThatMoveSmoothly) {
  SimulationSettings settings = pendulum(GetParam());
  settings.effects.add(smooth_pins());
  expect_second_beside_verlet(settings);
}

TEST_P(SecondOrder, HoldsForAirOnPinsThatMoveSmoothly) {
  SimulationSettings settings = pendulum(GetParam());
  settings.effects.add(drape::Air{.velocity = {0.3, -4, 0}});
  settings.effects.add(smooth_pins());
  expect_second_beside_verlet(settings);
}

class SecondOrderPush : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, SecondOrderPush, testing::ValuesIn(second_order_methods), method_name);

// A huge sphere acts as a plane that pushes with k·depth: a vertex oscillates about the depth g/k, and steps need not
// hit its turning points.
TEST_P(SecondOrderPush, HoldsForAVertexThatSwingsOnIt) {
  constexpr double k = 500, g = 9.8, duration = 1, radius = 1e4;
  SimulationSettings settings = setup(loose(RowVector3d(0, 0, -1.5 * g / k)), GetParam(), 1);
  settings.effects = {Gravity{},
                      Sphere{.center = Eigen::Vector3d(0, 0, -radius), .radius = radius, .scale = 1, .stiffness = k}};
  State exact{.x = settings.cloth.positions, .v = Vertices::Zero(1, 3)};
  exact.x(0, 2) = -g / k * (1 + 0.5 * std::cos(std::sqrt(k) * duration));
  exact.v(0, 2) = g / k * 0.5 * std::sqrt(k) * std::sin(std::sqrt(k) * duration);
  expect_second(orders(settings, exact, duration, 400));
}

/// A scene of the homework, up to the time when its springs buckle on all scales, and the numbers of steps to measure
/// its order.
struct Homework {
  const char* name;
  double stiffness, damping;
  bool sphere;
  int verlet_steps, sdirk2_steps;
};
void PrintTo(const Homework& scene, std::ostream* out) { *out << "scene " << scene.name; }
constexpr double until = 0.4;  // [s]
constexpr std::array homework_scenes{
    Homework{"1", 18, 0.2, false, 400, 80}, Homework{"2", 18, 1, false, 400, 160},
    Homework{"3", 180, 1, false, 400, 320}, Homework{"4", 1800, 1, false, 800, 800},
    Homework{"5", 180, 1, true, 400, 320},
};

SimulationSettings settings_of(const Homework& scene, Solver solver) {
  SimulationSettings settings = homework(solver, 1, scene.stiffness);
  if (scene.sphere) settings.effects.add(homework_sphere());
  if (scene.damping < 1) settings.effects.add(Damping{.factor = scene.damping});
  return settings;
}

/// Returns the scene's final state, computed with steps so small that their error is negligible.
const State& reference(const Homework& scene) {
  static std::map<std::string, State> states;
  const auto [place, missing] = states.try_emplace(scene.name);
  if (missing) place->second = run(settings_of(scene, Method::verlet), until, 20 * scene.verlet_steps);
  return place->second;
}

class SecondOrderHomework : public testing::TestWithParam<std::tuple<Homework, NamedMethod>> {};
INSTANTIATE_TEST_SUITE_P(Scene, SecondOrderHomework,
                         testing::Combine(testing::ValuesIn(homework_scenes), testing::ValuesIn(second_order_methods)),
                         [](const auto& scene) {
                           return std::string(std::get<0>(scene.param).name) + "_" + std::get<1>(scene.param).name;
                         });

TEST_P(SecondOrderHomework, HoldsForTheHomework) {
  const auto& [scene, method] = GetParam();
  const int steps = method.is_explicit() ? scene.verlet_steps : scene.sdirk2_steps;
  expect_second(orders(settings_of(scene, method), reference(scene), until, steps));
}

// Purpose of second order: bench/time_schemes.cpp measures the costs of these motions.
TEST(EqualErrors, AreThoseOfTheBenchmark) {
  constexpr double duration = 0.42;
  struct Motion {
    Solver solver;
    int steps;
    double tolerance, error;  // [m]
  };
  const auto expect_errors = [&](const Homework& scene, const std::vector<Motion>& motions) {
    const State exact = run(settings_of(scene, Method::verlet), duration, 21'000);
    for (const Motion& motion : motions) {
      SimulationSettings settings = settings_of(scene, motion.solver);
      settings.step = duration / motion.steps;
      settings.integrator.stop = StoppingRule::change;
      settings.integrator.tolerance = motion.tolerance;
      Simulation simulation(settings);
      for (int step = 0; step < motion.steps; ++step) simulation.step();
      EXPECT_LE(largest(simulation.state().x, exact.x), motion.error) << scene.name << " in " << motion.steps;
    }
  };
  expect_errors(homework_scenes[2],
                {{{Method::quasi_newton, TimeScheme::sdirk2}, 168, 1e-5, 1e-3}, {Method::liu13, 3500, 0.1, 1e-3}});
  expect_errors(homework_scenes[0], {{Method::verlet, 70, 0, 1e-3},
                                     {Method::semi_implicit, 420, 0, 1e-3},
                                     {Method::verlet, 220, 0, 1e-4},
                                     {Method::semi_implicit, 4200, 0, 1e-4}});
}

TEST(EqualErrors, OfXpbdAreThoseOfTheBenchmark) {
  constexpr double duration = 0.42;
  const Homework& scene = homework_scenes[2];
  const State exact = run(settings_of(scene, Method::verlet), duration, 21'000);
  const Cloth& cloth = settings_of(scene, Method::verlet).cloth;
  for (const auto& [steps, error] : {std::pair{650, 1e-2}, {4000, 1e-3}}) {
    textbook::Xpbd xpbd(cloth, {.step = duration / steps});
    xpbd.positions = cloth.positions;
    xpbd.velocities = cloth.velocities;
    for (int step = 0; step < steps; ++step) xpbd.step();
    const double reached = (xpbd.positions - exact.x).rowwise().norm().maxCoeff();
    EXPECT_LE(reached, error);
    EXPECT_GE(reached, 0.85 * error) << "fewer steps would do";
  }
}

// Verlet is reversible: the same steps lead back.
TEST(Verlet, GoesBackTheWayItCame) {
  SimulationSettings settings = homework(Method::verlet, 0.001, 180);
  Simulation simulation(settings);
  for (int step = 0; step < 300; ++step) simulation.step();
  EXPECT_GT(largest(simulation.state().x, settings.cloth.positions), 0.1);
  State back = simulation.state();
  back.v *= -1;
  simulation.restore(back);
  for (int step = 0; step < 300; ++step) simulation.step();
  EXPECT_LT(largest(simulation.state().x, settings.cloth.positions), 1e-9);
  EXPECT_LT(simulation.state().v.cwiseAbs().maxCoeff(), 1e-8);
}

}  // namespace
}  // namespace drape::test
