// Dashpots along springs and on bending: their laws with every method.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/air.hpp"
#include "drape/sim/effects/bending.hpp"
#include "drape/sim/effects/damping.hpp"
#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/moving_pins.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/dashpots.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/plain_springs.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

class InternalDamping : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, InternalDamping, testing::ValuesIn(all_methods), method_name);

drape::InternalDamping damped(double time) { return {.relaxation_time = time}; }

/// Solves so tightly that only the error of the time step remains.
void solve_exactly(SimulationSettings& settings) {
  settings.integrator.stop = StoppingRule::change;
  settings.integrator.tolerance = 1e-12;
  settings.integrator.max_iterations = 5000;
}

State end_of(SimulationSettings settings, double duration, int steps) {
  solve_exactly(settings);
  settings.step = duration / steps;
  Simulation simulation(settings);
  for (int step = 0; step < steps; ++step) simulation.step();
  return simulation.state();
}

double largest_distance(const Vertices& a, const Vertices& b) { return (a - b).rowwise().norm().maxCoeff(); }

/// Expects the order of convergence of a method between `steps` and twice as many.
void expect_order(Solver solver, const SimulationSettings& settings, const State& exact, double duration, int steps) {
  const State coarse = end_of(settings, duration, steps), fine = end_of(settings, duration, 2 * steps);
  const double least = solver.second_order() ? 1.75 : 0.85;
  EXPECT_GE(std::log2(largest_distance(coarse.x, exact.x) / largest_distance(fine.x, exact.x)), least)
      << "of the positions";
  EXPECT_GE(std::log2(largest_distance(coarse.v, exact.v) / largest_distance(fine.v, exact.v)), least)
      << "of the velocities";
}

// Two masses on a spring: s'' = −ω²(s + τ s') with ω² = k (1/m₁ + 1/m₂), so s decays as exp(−ω²τ t/2).
TEST_P(InternalDamping, LetsASpringDecayAsTheFormulaSays) {
  constexpr double stiffness = 50, time = 0.01, duration = 0.4, start = 0.05;
  Cloth cloth;
  cloth.positions = Vertices::Zero(2, 3);
  cloth.positions.row(1) = RowVector3d(0.6, 0, 0.8) * (1 + start);
  cloth.velocities = Vertices::Zero(2, 3);
  cloth.masses.resize(2);
  cloth.masses << 0.1, 0.3;
  cloth.springs = {{.i = 0, .j = 1, .rest_length = 1, .stiffness = stiffness}};
  SimulationSettings settings = setup(cloth, GetParam(), 1);
  settings.effects = {damped(time)};
  const double square = stiffness * (1 / 0.1 + 1 / 0.3), rate = square * time / 2;
  const double turn = std::sqrt(square - rate * rate), fading = start * std::exp(-rate * duration);
  const double stretch = fading * (std::cos(turn * duration) + rate / turn * std::sin(turn * duration));
  const double speed = -fading * square / turn * std::sin(turn * duration);
  State exact{.x = cloth.positions, .v = cloth.velocities};
  const RowVector3d along(0.6, 0, 0.8);
  exact.x.row(0) = 0.75 * (start - stretch) * along;
  exact.x.row(1) = (1 + start - 0.25 * (start - stretch)) * along;
  exact.v.row(0) = -0.75 * speed * along;
  exact.v.row(1) = 0.25 * speed * along;
  expect_order(GetParam(), settings, exact, duration, 200);
}

// The same for a cloth that swings and turns: the directions of the dashpots change during a step.
TEST_P(InternalDamping, HasTheOrderOfTheSchemeInASwingingCloth) {
  constexpr double time = 0.02, duration = 0.25;
  SimulationSettings settings = setup(cloth_of(make_grid(3, 3), 0.3, 30, {0, 3}), GetParam(), 1);
  settings.cloth.velocities = 0.5 * random_vertices(settings.cloth.vertex_count(), 3);
  settings.effects = {Gravity{}, damped(time)};
  const State exact = exact_motion(settings.cloth, Vector3d(0, 0, -9.8), 1, duration, 8000, time);
  expect_order(GetParam(), settings, exact, duration, 200);
}

// Substeps share kicks of the dashpots, and the order is that of whole steps.
TEST_P(InternalDamping, HasTheOrderOfTheSchemeInSubsteps) {
  if (!GetParam().is_explicit()) GTEST_SKIP() << "only explicit methods have substeps";
  constexpr double time = 0.02, duration = 0.25;
  SimulationSettings settings = setup(cloth_of(make_grid(3, 3), 0.3, 30, {0, 3}), GetParam(), 1);
  settings.cloth.velocities = 0.5 * random_vertices(settings.cloth.vertex_count(), 3);
  settings.effects = {Gravity{}, damped(time)};
  const State exact = exact_motion(settings.cloth, Vector3d(0, 0, -9.8), 1, duration, 8000, time);
  for (const int substeps : {6, 9}) {
    settings.integrator.substeps = substeps;
    expect_order(GetParam(), settings, exact, duration, 60);
  }
}

// With air, a field of velocity, bending and moving pins: second order towards its own limit.
TEST_P(InternalDamping, HasTheOrderOfTheSchemeBesideAllElse) {
  constexpr double duration = 0.25;
  SimulationSettings settings = setup(cloth_of(make_grid(3, 3), 0.3, 30, {0, 3}), GetParam(), 1);
  settings.cloth.positions.col(2) += 0.1 * settings.cloth.positions.col(0).array().square().matrix();
  settings.effects = {Gravity{},
                      Air{.velocity = {2, 1, 0}},
                      Field{.acceleration = {"-0.5*vx", "3*vz", "-3*vy"}},
                      Bending{.rigidity = 0.01},
                      MovingPins{.pins = {0}, .keyframes = {{0, {0, 0, 0}}, {1, {0, 0.4, 0}}}},
                      Damping{.factor = 0.5},
                      damped(0.02)};
  constexpr int steps = 100;
  const State coarse = end_of(settings, duration, steps), middle = end_of(settings, duration, 2 * steps),
              fine = end_of(settings, duration, 4 * steps);
  const double least = GetParam().second_order() ? 1.7 : 0.8;
  EXPECT_GE(std::log2(largest_distance(coarse.x, middle.x) / largest_distance(middle.x, fine.x)), least);
  EXPECT_GE(std::log2(largest_distance(coarse.v, middle.v) / largest_distance(middle.v, fine.v)), least);
}

RowVector3d momentum_of(const Cloth& cloth, const State& state) { return cloth.masses.transpose() * state.v; }
RowVector3d spin_of(const Cloth& cloth, const State& state) {
  RowVector3d sum = RowVector3d::Zero();
  for (Eigen::Index i = 0; i < state.x.rows(); ++i) {
    sum += cloth.masses[i] * Vector3d(state.x.row(i)).cross(Vector3d(state.v.row(i))).transpose();
  }
  return sum;
}

// The springs are as good as absent (k = 1e-9 N/m), so that all forces are those of the dashpots (τ k = 0.05 N·s/m).
// Backward Euler alone would lose angular momentum with every spring; with SDIRK2 each stage does.
TEST_P(InternalDamping, KeepsBothMomenta) {
  Cloth cloth = cloth_of(make_grid(4, 4), 0.5, 1e-9, {});
  const int count = cloth.vertex_count();
  cloth.positions += 0.1 * random_vertices(count, 1);
  cloth.velocities = random_vertices(count, 2);
  SimulationSettings settings = setup(cloth, GetParam(), 0.01);
  settings.effects = {damped(5e7)};
  solve_exactly(settings);
  Simulation simulation(settings);
  const State start = simulation.state();
  for (int step = 0; step < 20; ++step) simulation.step();
  const State& end = simulation.state();
  ASSERT_LT(simulation.energies().kinetic, 0.9 * 0.5 * cloth.masses.dot(start.v.rowwise().squaredNorm())) << "they act";
  EXPECT_LT((momentum_of(cloth, end) - momentum_of(cloth, start)).norm(), 1e-12);
  if (GetParam().scheme == TimeScheme::sdirk2) return;
  EXPECT_LT((spin_of(cloth, end) - spin_of(cloth, start)).norm(), 1e-9);
}

// A cloth that flies and turns rigidly, curved and with bending, is slowed by nothing.
TEST(Dashpots, DoNotResistRigidMotions) {
  Mesh mesh = irregular_mesh(9);
  mesh.positions.col(2) += 0.4 * mesh.positions.leftCols(2).rowwise().squaredNorm();
  const Cloth cloth = cloth_of(mesh, 1, 180, {});
  System system(cloth, 0.01);
  Bending{.rigidity = 0.3}.install(system);
  damped(0.1).install(system);
  ASSERT_EQ(system.dashpots.size(), 2U);
  const Vertices x = cloth.positions + 0.05 * random_vertices(cloth.vertex_count(), 4);
  const RowVector3d turn(1, -2, 0.5), flight(3, 1, -2);
  Vertices rigid(x.rows(), 3), product = Vertices::Zero(x.rows(), 3);
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    rigid.row(i) = flight + Vector3d(turn).cross(Vector3d(x.row(i))).transpose();
  }
  for (const auto& dashpots : system.dashpots) {
    dashpots->set_directions(x);
    product.setZero();
    dashpots->add_product(rigid, product);
    Vertices other = Vertices::Zero(x.rows(), 3);
    const Vertices any = random_vertices(x.rows(), 5);
    dashpots->add_product(any, other);
    EXPECT_LT(product.norm(), 1e-12 * other.norm());
    // The forces have no sum and no torque, and take energy.
    RowVector3d torque = RowVector3d::Zero();
    for (Eigen::Index i = 0; i < x.rows(); ++i) torque += Vector3d(x.row(i)).cross(Vector3d(other.row(i))).transpose();
    EXPECT_LT(other.colwise().sum().norm(), 1e-12 * other.norm());
    EXPECT_LT(torque.norm(), 1e-12 * other.norm());
    EXPECT_GT(other.cwiseProduct(any).sum(), 0);
  }
}

// An explicit step's map of the velocities: at most 1 and at least 0 for every mode, and of second order.
TEST(DampingKick, TakesEnergyAtAnyStiffnessAndKeepsMomentum) {
  const Cloth cloth = cloth_of(make_grid(8, 8), 1, 180, {});
  for (const double time : {1e-5, 1e-3, 0.1, 10.0}) {
    System system(cloth, 0.002);
    damped(time).install(system);
    DampingKick kick(system, system.step);
    kick.set_directions(cloth.positions + 0.1 * random_vertices(cloth.vertex_count(), 1));
    const Vertices start = random_vertices(cloth.vertex_count(), 2);
    Vertices v = start;
    const auto product = [&](const Vertices& a, const Vertices& b) {
      return cloth.masses.dot(a.cwiseProduct(b).rowwise().sum());
    };
    for (int turn = 0; turn < 30; ++turn) {
      const Vertices before = v;
      kick.apply(v);
      EXPECT_LE(product(v, v), product(before, before));
      EXPECT_GE(product(before, v), 0);
    }
    EXPECT_LT((cloth.masses.transpose() * (v - start)).norm(), 1e-12);
  }
}

TEST(DampingKick, AgreesWithTheExponentialToSecondOrder) {
  Cloth cloth;
  cloth.positions = Vertices::Zero(2, 3);
  cloth.positions(1, 0) = 1;
  cloth.velocities = Vertices::Zero(2, 3);
  cloth.masses.setConstant(2, 2.0);
  cloth.springs = {{.i = 0, .j = 1, .rest_length = 1, .stiffness = 1}};
  const auto error = [&](double h) {
    System system(cloth, h);
    damped(1).install(system);  // the relative velocity decays as exp(−τ k (1/m₁ + 1/m₂) t) = exp(−t)
    DampingKick kick(system, h);
    kick.set_directions(cloth.positions);
    Vertices v = Vertices::Zero(2, 3);
    v(1, 0) = 1;
    v(1, 1) = 1;  // across the spring
    kick.apply(v);
    EXPECT_EQ(v(0, 1), 0);
    EXPECT_NEAR(v(1, 1), 1, 1e-15);
    return std::abs(v(1, 0) - v(0, 0) - std::exp(-h));
  };
  EXPECT_NEAR(std::log2(error(0.02) / error(0.01)), 3, 0.1);
}

// The stages grow with the square root of z; a plain dashpot would need z/2 steps.
TEST(DampingKick, NeedsFewStages) {
  EXPECT_EQ(DampingKick::stages_for(0), 2);
  for (const double z : {10.0, 100.0, 1000.0}) {
    EXPECT_LE(DampingKick::stages_for(z), std::ceil(std::sqrt(1.6 * z + 1))) << z;
    EXPECT_GE(DampingKick::stages_for(z), std::floor(std::sqrt(1.5 * z))) << z;
  }
}

// Kicks of the dashpots lie symmetrically in a step of any number of substeps.
TEST(DampingKick, ActsSymmetricallyInAStep) {
  for (std::int64_t substeps = 1; substeps <= 400; ++substeps) {
    std::int64_t kicks = 0;
    for (std::int64_t k = 0; k < substeps; ++k) {
      const bool acts = DampingKick::acts_in(7 * substeps + k, substeps);
      kicks += acts ? 1 : 0;
      EXPECT_EQ(acts, DampingKick::acts_in(substeps - 1 - k, substeps)) << k << " of " << substeps;
    }
    EXPECT_EQ(kicks, DampingKick::kicks_in(substeps)) << substeps;
    EXPECT_LE(substeps, 24 * kicks);
  }
}

TEST(DampingKick, RefusesWhatWouldTakeForEver) {
  SimulationSettings settings = homework(Method::verlet, 0.001, 180);
  settings.effects.add(damped(1e9));
  EXPECT_THROW(Simulation{settings}, UsageError);
  settings.integrator.method = Method::liu13;
  EXPECT_NO_THROW(Simulation{settings});
}

// A crumpled cloth without loads, at nearly the longest step that is safe without dashpots.
TEST_P(InternalDamping, OnlyTakesEnergyAtTheSafeStep) {
  for (const double time : {1e-4, 1e-2, 1.0}) {
    SimulationSettings settings = setup(cloth_of(make_grid(6, 6), 1, 180, {0, 6}), GetParam(), 0.01);
    settings.cloth.velocities = random_vertices(settings.cloth.vertex_count(), 6);
    settings.effects = {Bending{.rigidity = 0.01}, damped(time)};
    const double safe = safe_step(make_system(settings));
    const int substeps = GetParam().is_explicit() ? 9 : 1;
    settings.step = 0.95 * safe * substeps;
    if (substeps > 1) settings.integrator.substeps = substeps;
    solve_exactly(settings);
    settings.integrator.tolerance = 1e-7;
    Simulation simulation(settings);
    const double start = simulation.energies().total();
    double highest = 0;
    for (int step = 0; step < 900 / substeps; ++step) {
      simulation.step();
      highest = std::max(highest, simulation.energies().total());
    }
    // At r = 0.95 of the safe step, undamped symplectic Euler varies the energy by up to (1 + r)/(1 − r).
    const double swing = GetParam().is_explicit() ? 1.95 / 0.05 : 1.01;
    EXPECT_LE(highest, swing * start) << time;
    EXPECT_LT(simulation.energies().total(), 0.9 * start) << time;
  }
}

// Hanging cloth at long steps: backward Euler loses energy with any dashpots.
TEST_P(InternalDamping, GivesHangingClothNoEnergy) {
  if (GetParam().second_order() || GetParam().is_explicit()) GTEST_SKIP() << "only backward Euler promises it";
  for (const double stiffness : {180.0, 1e5}) {
    for (const double time : {1e-3, 0.02, 1.0}) {
      SimulationSettings settings = setup(cloth_of(make_grid(6, 6), 1, stiffness, {0, 6}), GetParam(), 0.02);
      settings.effects = {Gravity{}, Bending{.rigidity = 1e-3}, damped(time)};
      Simulation simulation(settings);
      const Energies start = simulation.energies();
      double work = 0, highest = start.total();
      for (int step = 0; step < 100; ++step) {
        simulation.step();
        work = std::max(work, start.gravity - simulation.energies().gravity);
        highest = std::max(highest, simulation.energies().total());
      }
      EXPECT_LE(highest, start.total() + 1e-3 * work) << stiffness << " N/m, " << time << " s";
    }
  }
}

/// Frequency and decay of a swinging strip [1/s].
struct Swing {
  double frequency, rate;
};

/// Lets a strip that is clamped at one end swing in about its lowest mode, and measures it from the first to the
/// seventh zero of its tip, where all energy is kinetic.
Swing swing(double relaxation) {
  Mesh mesh = make_grid(12, 2);
  mesh.positions.col(1) *= 0.2;
  std::vector<int> clamp;
  for (int i = 0; i < mesh.positions.rows(); ++i) {
    if (mesh.positions(i, 0) < -0.8) clamp.push_back(i);
  }
  SimulationSettings settings = setup(cloth_of(mesh, 0.2, 1000, clamp), Method::verlet, 2e-4);
  for (int i = 0; i < mesh.positions.rows(); ++i) {
    const double s = std::max(0.0, (mesh.positions(i, 0) + 5.0 / 6) / (11.0 / 6));
    settings.cloth.velocities(i, 2) = 0.02 * s * s * (6 - 4 * s + s * s);
  }
  settings.effects = {Bending{.rigidity = 20}};
  if (relaxation > 0) settings.effects.add(damped(relaxation));
  Simulation simulation(settings);
  const Eigen::Index tip = mesh.positions.rows() - 1;
  std::vector<double> times, energies;
  double last = 0;
  for (int step = 1; step <= 20000 && times.size() < 7; ++step) {
    simulation.step();
    const double now = simulation.state().x(tip, 2);
    if (now * last < 0) {
      times.push_back(step * settings.step);
      energies.push_back(simulation.energies().total());
    }
    last = now;
  }
  EXPECT_EQ(times.size(), 7U);
  if (times.size() < 7) return {};
  const double duration = times[6] - times[0];
  return {.frequency = 3 * 2 * std::numbers::pi / duration, .rate = std::log(energies[0] / energies[6]) / 2 / duration};
}

// Its bending dashpots bring it to rest at the rate ω²τ/2 of its lowest mode.
TEST(InternalDampingOfBending, DecaysAtTheRateOfTheMode) {
  constexpr double time = 0.01;
  const Swing free = swing(0), slowed = swing(time);
  EXPECT_LT(std::abs(free.rate), 1e-3 * free.frequency);
  EXPECT_NEAR(slowed.rate, free.frequency * free.frequency * time / 2, 0.05 * slowed.rate);
}

// The curvature of a flat sheet is rounding, which has no direction: its first step is the same in any pose.
TEST_P(InternalDamping, BendsAFlatSheetAlikeInAnyPose) {
  const auto first_step = [](const Eigen::Matrix3d& turn) {
    Mesh mesh = make_grid(6, 2);
    mesh.positions.col(1) *= 0.2;
    mesh.positions = (mesh.positions * turn.transpose()).eval();
    SimulationSettings settings = setup(cloth_of(mesh, 0.2, 100, {0, 7, 14}), GetParam(), 0.005);
    settings.effects = {Gravity{.acceleration = turn * Vector3d(0, 0, -9.8)}, Bending{.rigidity = 1e-2}, damped(3)};
    if (!GetParam().is_explicit()) {
      settings.integrator.stop = StoppingRule::error;
      settings.integrator.tolerance = 1e-10;
    }
    Simulation simulation(settings);
    simulation.step();
    return Vertices(simulation.state().x * turn);
  };
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.65, Vector3d(3, 1, 2).normalized()).toRotationMatrix();
  EXPECT_LT((first_step(turn) - first_step(Eigen::Matrix3d::Identity())).cwiseAbs().maxCoeff(), 1e-8);
}

// Contact and dashpots together: a cloth falls on the ground and stays above it.
TEST_P(InternalDamping, LeavesContactAsItIs) {
  SimulationSettings settings = setup(cloth_of(make_grid(6, 6), 1, 180, {}), GetParam(), 0.002);
  settings.effects = {Gravity{}, Ground{.height = -0.2, .friction = 0.5}, damped(0.02)};
  Simulation simulation(settings);
  for (int step = 0; step < 250; ++step) {
    simulation.step();
    ASSERT_GE(simulation.state().x.col(2).minCoeff(), -0.2 - 1e-6) << step;
  }
  EXPECT_LT(simulation.energies().kinetic, 0.05) << "it lies";
}

// `accuracy` sees the dashpots, too.
TEST_P(InternalDamping, IsPartOfTheAccuracyAsked) {
  constexpr double time = 0.02, duration = 0.2;
  SimulationSettings settings = setup(cloth_of(make_grid(4, 4), 0.4, 60, {0, 4}), GetParam(), 0.02);
  settings.effects = {Gravity{}, damped(time)};
  settings.integrator.stop.reset();
  settings.integrator.tolerance.reset();
  settings.accuracy = 1e-4;
  Simulation simulation(settings);
  for (int step = 0; step < 10; ++step) EXPECT_TRUE(simulation.step().converged);
  const State exact = exact_motion(settings.cloth, Vector3d(0, 0, -9.8), 1, duration, 4000, time);
  EXPECT_LT(largest_distance(simulation.state().x, exact.x), 10 * 1e-4);
}

}  // namespace
}  // namespace drape::test
