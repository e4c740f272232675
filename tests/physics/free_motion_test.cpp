// Free cloths: fall, drift and rotation are known exactly.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/bending.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

class FreeMotion : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, FreeMotion, testing::ValuesIn(all_methods), method_name);

/// Makes a cloth of uneven masses without pins.
Cloth uneven_cloth(double stiffness) {
  Cloth cloth = cloth_of(irregular_mesh(8), 1, stiffness, {});
  for (int i = 0; i < cloth.vertex_count(); ++i) cloth.masses[i] *= 1 + 0.5 * std::sin(i);
  return cloth;
}

/// Makes the cloth drift, turn and deform, not as a rigid motion.
Cloth moving_cloth(double stiffness) {
  Cloth cloth = uneven_cloth(stiffness);
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    const Eigen::RowVector3d x = cloth.positions.row(i);
    cloth.velocities.row(i) << 1 - 2 * x[1] + 0.3 * x[0], 0.5 + 2 * x[0], -0.3 + std::sin(3 * x[0]);
  }
  return cloth;
}

Eigen::RowVector3d momentum(const Cloth& cloth, const State& state) { return cloth.masses.transpose() * state.v; }

Eigen::RowVector3d angular_momentum(const Cloth& cloth, const State& state) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    sum += cloth.masses[i] * state.x.row(i).cross(state.v.row(i));
  }
  return sum;
}

TEST_P(FreeMotion, FallsAsTheSumOfItsStepsSays) {
  constexpr int steps = 50;
  constexpr double h = 0.01;
  SimulationSettings settings = setup(uneven_cloth(2), GetParam(), h);
  settings.effects = {Gravity{}, Wind{.acceleration = {3, -1, 0.5}}};
  const Eigen::RowVector3d acceleration(3, -1, -9.3);
  Simulation simulation(settings);
  for (int step = 0; step < steps; ++step) simulation.step();

  // v = n h a, and x = x₀ + (1 + … + n) h² a in both Euler schemes and x₀ + n² h²/2 a in the others. Each step rounds
  // x, of about 1 m, once. Implicit methods compute v as a difference of such numbers, an error that later steps carry
  // on.
  const double rounding = 4 * steps * steps * std::numeric_limits<double>::epsilon();
  const int more = GetParam().second_order() ? 0 : 1;
  const Vertices fallen = settings.cloth.positions.rowwise() + h * h * steps * (steps + more) / 2 * acceleration;
  EXPECT_LT((simulation.state().x - fallen).cwiseAbs().maxCoeff(), rounding);
  const Eigen::RowVector3d velocity = steps * h * acceleration;
  EXPECT_LT((simulation.state().v.rowwise() - velocity).cwiseAbs().maxCoeff(), rounding / h);
}

class SolvedMotion : public FreeMotion {};
INSTANTIATE_TEST_SUITE_P(With, SolvedMotion, testing::ValuesIn(implicit_methods), method_name);
INSTANTIATE_TEST_SUITE_P(WithSdirk2, SolvedMotion, testing::ValuesIn(sdirk2_methods), method_name);

// The bending energy of a flat cloth is the difference of large terms, and rounding may make it negative.
TEST_P(SolvedMotion, SolvesEveryStepOfAFallingFabric) {
  Mesh mesh = make_grid(12, 12);
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 3).normalized();
  mesh.positions = mesh.positions * Eigen::AngleAxisd(1.2, axis).toRotationMatrix().transpose() / 2;
  for (const Fabric& fabric : fabrics()) {
    SimulationSettings settings;
    settings.integrator.method = GetParam().method;
    settings.integrator.scheme = GetParam().scheme;
    settings.integrator.linear_solver = GetParam().linear_solver;
    settings.cloth = cloth_of(mesh, fabric.density, 1, {});
    stiffen_by_direction(fabric.modulus, settings.cloth);
    settings.effects = {Gravity{}, Bending{.rigidity = fabric.rigidity}};
    for (const double h : {0.002, 0.02}) {
      settings.step = h;
      Simulation simulation(settings);
      for (int step = 1; step <= 30; ++step) ASSERT_TRUE(simulation.step().converged) << fabric.name << ", " << step;
    }
  }
}

// Springs pull with opposite forces. Even if a step stops early and solves coarsely (factors are in single precision),
// the momentum changes only by rounding: of positions of about 1 m, whose differences over h are the velocities of
// implicit methods.
TEST_P(FreeMotion, KeepsItsMomentumHoweverLooselyItIsSolvedFor) {
  constexpr int steps = 50;
  const double h = GetParam().is_explicit() ? 0.001 : 0.02;
  for (const double tolerance : {1e-3, 1.0}) {
    SimulationSettings settings = setup(moving_cloth(180), GetParam(), h);
    settings.integrator.tolerance = tolerance;
    const Cloth& cloth = settings.cloth;
    Simulation simulation(settings);
    const Eigen::RowVector3d before = momentum(cloth, simulation.state());
    for (int step = 0; step < steps; ++step) simulation.step();
    const Eigen::RowVector3d after = momentum(cloth, simulation.state());
    const double rounding = 2 * steps * std::numeric_limits<double>::epsilon() * cloth.masses.sum() / h;
    EXPECT_LT((after - before).norm(), rounding) << "at " << tolerance;
  }
}

class ExplicitMotion : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(With, ExplicitMotion, testing::Values(Method::semi_implicit, Method::verlet),
                         [](const auto& method) { return method.param == Method::verlet ? "Verlet" : "SemiImplicit"; });

// Forces along the springs have no torque: explicit methods move x by a multiple of v, so Σ m x × v changes only by
// Σ x × force = 0.
TEST_P(ExplicitMotion, KeepsItsAngularMomentum) {
  SimulationSettings settings = setup(moving_cloth(180), GetParam(), 0.001);
  Simulation simulation(settings);
  const Eigen::RowVector3d before = angular_momentum(settings.cloth, simulation.state());
  constexpr int steps = 1000;
  for (int step = 0; step < steps; ++step) simulation.step();
  const Eigen::RowVector3d after = angular_momentum(settings.cloth, simulation.state());
  ASSERT_GT(before.norm(), 0.1);
  EXPECT_LT((after - before).norm(), 10 * steps * std::numeric_limits<double>::epsilon() * before.norm());
}

// Two masses at the ends of a stiff spring turn by θ in a step. Backward Euler's velocity is the chord's, and the
// spring pulls along its direction at the step's end, so sin(θ' + θ) = 2 sin θ', or θ' = θ − θ³ + O(θ⁵): a share of hω²
// of the angular momentum is lost per second. SDIRK2 loses none of that order.
TEST(FreeMotionOfARotor, LosesTheAngularMomentumThatDocsSay) {
  constexpr double h = 0.002, omega = 4.64, time = 1;
  for (const TimeScheme scheme : {TimeScheme::backward_euler, TimeScheme::sdirk2}) {
    Cloth cloth;
    cloth.positions = Vertices::Zero(2, 3);
    cloth.positions.col(0) << -0.5, 0.5;
    cloth.rest = cloth.positions;
    cloth.velocities = Vertices::Zero(2, 3);
    cloth.velocities.col(1) = omega * cloth.positions.col(0);
    cloth.masses.setConstant(2, 0.1);
    cloth.springs = {{.i = 0, .j = 1, .rest_length = 1, .stiffness = 1e5}};
    SimulationSettings settings = setup(cloth, {Method::implicit, scheme}, h);
    settings.integrator.stop = StoppingRule::error;
    settings.integrator.tolerance = 1e-13;
    settings.integrator.max_iterations = 200;
    Simulation simulation(settings);
    const double before = angular_momentum(cloth, simulation.state()).norm();
    while (simulation.time() < time - h / 2) simulation.step();
    const double kept = angular_momentum(cloth, simulation.state()).norm() / before;
    const double expected = scheme == TimeScheme::sdirk2 ? 1 : 1 / std::sqrt(1 + 2 * h * omega * omega * time);
    EXPECT_NEAR(kept, expected, 2e-3);
  }
}

TEST_P(FreeMotion, IsDampedAlikeAtAnyStepLength) {
  constexpr double factor = 0.2;
  for (const int steps : {10, 100, 1000}) {
    SimulationSettings settings = setup(cloth_of(make_grid(4, 4), 1, 0.1, {}), GetParam(), 1.0 / steps);
    settings.cloth.velocities.rowwise() = Eigen::RowVector3d(0.3, -0.2, 1);
    settings.effects = {Damping{.factor = factor}};
    Simulation simulation(settings);
    const double before = simulation.energies().kinetic;
    for (int step = 0; step < steps; ++step) simulation.step();
    const double expected = factor * factor * before;  // every velocity is reduced by the factor
    // Rounding x, of about 1 m, by half a unit changes v = Δx/h by that over h, once in every step.
    const double rounding = 10.0 * steps * steps * std::numeric_limits<double>::epsilon();
    EXPECT_NEAR(simulation.energies().kinetic, expected, rounding * expected) << "in " << steps << " steps";
  }
}

// Semi-implicit Euler moves with the damped velocity, backward Euler damps after the move, and second-order schemes do
// half of it before and half after.
TEST_P(FreeMotion, IsDampedBeforeTheSemiImplicitMoveAndAfterTheImplicitOne) {
  constexpr double h = 0.1, factor = 0.2;
  SimulationSettings settings = setup(cloth_of(make_grid(2, 2), 1, 0.1, {}), GetParam(), h);
  settings.cloth.velocities.col(0).setOnes();
  settings.effects = {Damping{.factor = factor}};
  Simulation simulation(settings);
  simulation.step();
  const double left = std::pow(factor, h);
  const double way = h * (GetParam().second_order() ? std::sqrt(left) : GetParam().is_explicit() ? left : 1);
  const Vertices moved = simulation.state().x - settings.cloth.positions;
  EXPECT_LT((moved.col(0).array() - way).abs().maxCoeff(), 1e-14);
  EXPECT_LT((simulation.state().v.col(0).array() - left).abs().maxCoeff(), 1e-13);
}

}  // namespace
}  // namespace drape::test
