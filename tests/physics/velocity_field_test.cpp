// Velocity-dependent fields: a scheme's effect on an isolated vertex is known exactly, and energy that a field takes or
// turns never comes back.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/air.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/solvers/anderson.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"
#include "sim/velocity_field.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

using Complex = std::complex<double>;
using Eigen::RowVector3d;

const double gamma = 1 - std::sqrt(0.5);  // of SDIRK2

/// Returns the factor of v in a step of v' = λ v, with z = hλ.
Complex left_of_velocity(const NamedMethod& method, Complex z) {
  if (method.is_explicit()) return (1.0 + z / 2.0) / (1.0 - z / 2.0);
  if (method.scheme == TimeScheme::sdirk2) {
    return (1.0 + (1 - 2 * gamma) * z) / ((1.0 - gamma * z) * (1.0 - gamma * z));
  }
  return 1.0 / (1.0 - z);
}

/// Makes a small patch of cloth at (x, 0, 0), with the velocity of its middle throughout.
SimulationSettings patch(const NamedMethod& method, double x, const RowVector3d& velocity, const Field& field) {
  constexpr double mass = 0.05, stiffness = 2, size = 0.02, step = 0.01;
  Mesh mesh = make_grid(3, 3);
  mesh.positions *= size;
  Cloth cloth = cloth_of(mesh, mass, stiffness, {});
  cloth.positions.rowwise() += RowVector3d(x, 0, 0);
  cloth.velocities = velocity.replicate(cloth.vertex_count(), 1);
  SimulationSettings settings = setup(std::move(cloth), method, method.is_explicit() ? step / 10 : step);
  settings.effects = {field};
  return settings;
}

RowVector3d middle_of(const Vertices& x) { return x.colwise().mean(); }

class VelocityField : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, VelocityField, testing::ValuesIn(all_methods), method_name);

// In a frame that rotates with ω, a patch at rest outside moves on a circle. Backward Euler leaves 1/√(1 + h²ω²) of the
// radius in every step; the other methods conserve it. With the scene's default tolerance.
TEST_P(VelocityField, ATurningFrameKeepsWhatRestsOutside) {
  constexpr double omega = 4, time = 5;
  SimulationSettings settings =
      patch(GetParam(), 1, {0, -omega, 0},
            {.acceleration = {"16*x + 8*vy", "16*y - 8*vx", "0"}, .stiffness_bound = omega * omega});
  settings.integrator.stop.reset();
  settings.integrator.tolerance.reset();
  Simulation simulation(settings);
  while (simulation.time() < time - 1e-9) simulation.step();
  const double h = settings.step;
  if (GetParam().second_order()) {
    const RowVector3d exact(std::cos(omega * time), -std::sin(omega * time), 0);
    EXPECT_LT((middle_of(simulation.state().x) - exact).norm(), 0.01);
  } else if (!GetParam().is_explicit()) {
    const Complex exact = std::pow(1.0 / Complex(1, h * omega), std::lround(time / h));
    EXPECT_LT((middle_of(simulation.state().x) - RowVector3d(exact.real(), exact.imag(), 0)).norm(), 0.01);
    EXPECT_NEAR(middle_of(simulation.state().x).norm() / std::exp(-h * omega * omega * time / 2), 1, 0.01);
  } else {
    EXPECT_LT(middle_of(simulation.state().x).norm(), 1.2);
  }
}

// For v' = λ v, λ = −c or iω, every scheme follows its stability function, from gentle to stiff.
TEST_P(VelocityField, EveryStepKeepsOfTheVelocityWhatTheSchemeSays) {
  constexpr int steps = 4;
  const auto check = [&](const Field& field, Complex rate) {
    SimulationSettings settings = patch(GetParam(), 0, {3, 0, 0}, field);
    settings.integrator.stop = StoppingRule::error;
    settings.integrator.tolerance = 1e-12;
    Simulation simulation(settings);
    for (int i = 0; i < steps; ++i) EXPECT_TRUE(simulation.step().converged);
    const Complex kept = 3.0 * std::pow(left_of_velocity(GetParam(), settings.step * rate), steps);
    const RowVector3d v = middle_of(simulation.state().v);
    EXPECT_NEAR(v[0], kept.real(), 1e-7) << field.acceleration[0];
    EXPECT_NEAR(v[1], kept.imag(), 1e-7) << field.acceleration[0];
  };
  check({.acceleration = {"-3*vx", "0", "0"}}, -3);
  check({.acceleration = {"-250*vx", "0", "0"}}, -250);
  check({.acceleration = {"-1e5*vx", "-2e5*vy", "0"}}, -1e5);
  check({.acceleration = {"-8*vy", "8*vx", "0"}}, {0, 8});
  check({.acceleration = {"-200*vy", "200*vx", "0"}}, {0, 200});
  check({.acceleration = {"-20*vx - 100*vy", "100*vx - 20*vy", "-vz*vz"}}, {-20, 100});
}

// Drag and forces across the velocity give no energy: kinetic plus elastic energy never exceeds its initial value, for
// any size of drag or rotation. With the default tolerance.
TEST_P(VelocityField, WhatCannotGiveEnergyGivesNone) {
  const std::vector<std::array<std::string, 3>> fields = {
      {"-250*vx", "0", "0"},
      {"-1e4*vx", "-1e4*vy", "-1e4*vz"},
      {"8*vy", "-8*vx", "0"},
      {"80*vy", "-80*vx", "0"},
      {"800*vy", "-800*vx", "0"},
      {"-50*vx*sqrt(vx^2+vy^2+vz^2)", "-50*vy*sqrt(vx^2+vy^2+vz^2)", "-50*vz*sqrt(vx^2+vy^2+vz^2)"},
      {"-1000*vx^3", "-1000*vy^3", "-1000*vz^3"},
      {"(1+x^2)*30*vz", "0", "-(1+x^2)*30*vx"}};
  for (const double stiffness : {5.0, 500.0}) {
    for (const auto& field : fields) {
      SimulationSettings settings =
          setup(cloth_of(make_grid(6, 6), 0.3, stiffness, {0}), GetParam(), GetParam().is_explicit() ? 0.001 : 0.02);
      settings.integrator.stop.reset();
      settings.integrator.tolerance.reset();
      // The default of 100 iterations is too small for liu13 with such stiff springs, with or without a field.
      if (GetParam().method == Method::liu13) settings.integrator.max_iterations = 2000;
      settings.cloth.velocities = random_vertices(settings.cloth.vertex_count(), 5);
      settings.effects = {Field{.acceleration = field, .stiffness_bound = 1}};
      const double explicit_limit = BlowUpWatch::limit(settings.step / safe_step(make_system(settings)));
      Simulation simulation(settings);
      const Energies start = simulation.energies();
      int left = 0;
      for (int i = 0; i < 50; ++i) {
        left += simulation.step().converged ? 0 : 1;
        const Energies now = simulation.energies();
        // An explicit step conserves another energy, see BlowUpWatch, and SDIRK2 is not algebraically stable.
        const double kept = GetParam().is_explicit() ? explicit_limit : GetParam().second_order() ? 1.05 : 1.01;
        const double most = kept * (start.kinetic + start.elastic);
        ASSERT_LE(now.kinetic + now.elastic, most) << field[0] << ", k = " << stiffness << ", step " << i;
      }
      EXPECT_LE(left, 5) << field[0] << ", k = " << stiffness;
    }
  }
}

// Every implicit method ends a step of backward Euler at M (v' − v)/h = F(x') + M a(x', v', t').
TEST(VelocityFields, ImplicitMethodsAgreeOnAStep) {
  const Field field{.acceleration = {"-9*vx*abs(vx) + 30*vy", "-30*vx - x*vy", "-9.8 - 2*vz + sin(t)"}};
  for (const TimeScheme scheme : {TimeScheme::backward_euler, TimeScheme::sdirk2}) {
    std::vector<Vertices> places;
    for (const Method method : {Method::implicit, Method::quasi_newton, Method::liu13}) {
      SimulationSettings settings = homework(method, 0.02, 180);
      settings.integrator.scheme = scheme;
      settings.integrator.stop = StoppingRule::error;
      settings.integrator.tolerance = 1e-9;
      settings.integrator.max_iterations = 20000;
      settings.effects = {field};
      Simulation simulation(settings);
      for (int i = 0; i < 5; ++i) EXPECT_TRUE(simulation.step().converged);
      places.push_back(simulation.state().x);
    }
    EXPECT_LT((places[0] - places[1]).rowwise().norm().maxCoeff(), 1e-6);
    EXPECT_LT((places[0] - places[2]).rowwise().norm().maxCoeff(), 1e-6);
  }
}

// Combined with air, gravity and damping, which are evaluated and not solved for, a field keeps second order.
TEST(VelocityFields, KeepTheSecondOrderBesideOthers) {
  constexpr double time = 0.4;
  for (const NamedMethod& method : second_order_methods) {
    const auto end = [&](int steps) {
      SimulationSettings settings = homework(method, time / steps, 20);
      settings.cloth.velocities.col(0).setConstant(1);
      settings.integrator.stop = StoppingRule::error;
      settings.integrator.tolerance = 1e-11;
      settings.integrator.max_iterations = 20000;
      settings.effects = {Gravity{}, Air{.velocity = {1, 2, 0}},
                          Field{.acceleration = {"6*vy - x", "-6*vx - y", "-2*vz*vz*vz"}, .stiffness_bound = 2},
                          Damping{.factor = 0.3}};
      Simulation simulation(settings);
      for (int i = 0; i < steps; ++i) simulation.step();
      return simulation.state().x;
    };
    const Vertices coarse = end(200), fine = end(400), finest = end(800);
    const double order = std::log2((coarse - fine).norm() / (fine - finest).norm());
    EXPECT_GT(order, 1.8) << method_name(testing::TestParamInfo<NamedMethod>(method, 0));
  }
}

TEST_P(VelocityField, ThatIsNoNumberEndsTheRunAtOnce) {
  for (const bool asked : {false, true}) {
    SimulationSettings settings = homework(GetParam(), 0.002, 180);
    if (asked) settings.accuracy = 1e-2;
    settings.effects = {Field{.acceleration = {"0", "0", "vx/0"}}};
    Simulation simulation(settings);
    EXPECT_THROW(simulation.step(), DivergedError) << asked;
  }
}

TEST(FieldSlopes, AreExactOfQuadraticFields) {
  SimulationSettings settings = homework(Method::implicit, 0.01, 180);
  settings.effects = {Field{.acceleration = {"2*x*vy + 3*vz", "vx^2 - z", "t*vz + y*y"}}};
  const System system = make_system(settings);
  State state{.x = random_vertices(441, 1), .v = 4 * random_vertices(441, 2)};
  FieldSlopes slopes(system);
  constexpr double t = 0.7;
  slopes.find(state, t);
  for (const Eigen::Index i : {5, 200, 440}) {
    Eigen::Matrix3d by_position, by_velocity;
    by_position << 2 * state.v(i, 1), 0, 0, 0, 0, -1, 0, 2 * state.x(i, 1), 0;
    by_velocity << 0, 2 * state.x(i, 0), 3, 2 * state.v(i, 0), 0, 0, 0, 0, t;
    EXPECT_LT((slopes.by_position()[static_cast<std::size_t>(i)] - by_position).norm(), 1e-8);
    EXPECT_LT((slopes.by_velocity()[static_cast<std::size_t>(i)] - by_velocity).norm(), 1e-8);
  }
}

// Its gradient is the slope of its energy, and its Hessian that of its gradient; both vanish outside of a step, and its
// bound holds.
TEST(FieldDrag, HasTheDerivativesThatItSays) {
  SimulationSettings settings = homework(Method::quasi_newton, 0.02, 180);
  settings.effects = {Field{.acceleration = {"-30*vx + 5*vy - x", "-2*vy", "-100*vz + 7*vx"}}};
  const System system = make_system(settings);
  ASSERT_NE(system.drag, nullptr);
  FieldDrag& drag = *system.drag;
  const Vertices start = random_vertices(441, 3), x = random_vertices(441, 4), way = random_vertices(441, 5);
  Vertices gradient = Vertices::Zero(441, 3);
  EXPECT_EQ(drag.add_gradient(x, 0, gradient), 0);
  EXPECT_EQ(gradient.norm(), 0);
  drag.begin({.x = start, .v = way}, 0, start);
  const double energy = drag.add_gradient(x, 0, gradient);
  Vertices ignored = gradient, after = Vertices::Zero(441, 3), product = after;
  constexpr double small = 1e-6;
  const double more = drag.add_gradient(x + small * way, 0, after),
               less = drag.add_gradient(x - small * way, 0, ignored);
  EXPECT_GT(energy, 0);
  EXPECT_NEAR((more - less) / (2 * small), gradient.cwiseProduct(way).sum(), 1e-6 * energy);
  const auto hessian = drag.make_hessian();
  hessian->linearise(x, 0, 0);
  hessian->add_product(way, product);
  EXPECT_LT((product - (after - gradient) / small).norm(), 1e-6 * product.norm());
  StiffnessBound bound{.vertices = Eigen::VectorXd::Zero(441)};
  drag.add_bound(bound);
  EXPECT_LE(product.cwiseProduct(way).sum(), bound.vertices.dot(way.rowwise().squaredNorm()) * (1 + 1e-9));
  drag.end();
  EXPECT_EQ(drag.add_gradient(x, 0, ignored), 0);
}

// For a linear iteration with m distinct factors, some with real parts far above one, the acceleration finds the fixed
// point in m + 1 steps, as GMRES does.
TEST(Anderson, FindsTheFixedPointOfALinearIteration) {
  const Vertices target = random_vertices(40, 7);
  const std::array factors = {0.9, -3.0, 0.2, 5.0};
  AndersonIteration iteration(40);
  Vertices c = Vertices::Zero(40, 3), residual;
  for (int step = 0; step < 5; ++step) {
    residual = target - c;
    for (Eigen::Index i = 0; i < 40; ++i) residual.row(i) *= 1 - factors.at(static_cast<std::size_t>(i % 4));
    iteration.advance(residual, c);
  }
  EXPECT_LT((c - target).norm(), 1e-9 * target.norm());
}

}  // namespace
}  // namespace drape::test
