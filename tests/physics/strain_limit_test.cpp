#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/damping.hpp"
#include "drape/sim/effects/strain_limit.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/system.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

class StrainLimit : public testing::TestWithParam<NamedMethod> {
 protected:
  static double step() { return GetParam().is_explicit() ? 0.002 : 0.02; }
};
INSTANTIATE_TEST_SUITE_P(With, StrainLimit, testing::ValuesIn(all_methods), method_name);

/// Extreme stretches of a cloth's edges, except edges between pins.
struct Extremes {
  double least = std::numeric_limits<double>::infinity(), most = 0;
};
Extremes extremes(const Cloth& cloth, const Vertices& x) {
  Extremes e;
  for (const Spring& s : cloth.springs) {
    const double stretch = (x.row(s.i) - x.row(s.j)).norm() / s.rest_length;
    e = {std::min(e.least, stretch), std::max(e.most, stretch)};
  }
  return e;
}

// So soft that some of its edges would more than double their length.
TEST_P(StrainLimit, HoldsAHangingClothAtEveryStep) {
  SimulationSettings settings = homework(GetParam(), step(), 5);
  settings.integrator.max_iterations = 2000;
  const auto without = settings.effects;
  settings.effects.add(drape::StrainLimit{.max_stretch = 1.1, .tolerance = 1e-3});
  Simulation simulation(settings);
  double most = 0;
  while (simulation.time() < 2) {
    EXPECT_TRUE(simulation.step().converged) << "step " << simulation.state().step;
    most = std::max(most, extremes(settings.cloth, simulation.state().x).most);
  }
  EXPECT_LE(most, 1.1 * 1.001 + 1e-9);
  EXPECT_GT(most, 1.09) << "the limit was never felt";

  settings.effects = without;
  Simulation unlimited(settings);
  while (unlimited.time() < 1) unlimited.step();
  EXPECT_GT(extremes(settings.cloth, unlimited.state().x).most, 2) << "nothing to hold";
}

// A strip hangs from one side, and its lower half is suddenly kicked down and aside.
TEST_P(StrainLimit, HoldsUnderASuddenLoad) {
  Mesh mesh = make_grid(4, 16);
  mesh.positions.col(0) *= 0.25;
  std::vector<int> top{80, 81, 82, 83, 84};
  SimulationSettings settings = setup(cloth_of(mesh, 0.5, 20, top), GetParam(), step());
  for (int i = 0; i < 40; ++i) settings.cloth.velocities.row(i) << 3, -8, 2;
  settings.effects = {Gravity{}, drape::StrainLimit{.max_stretch = 1.05, .min_stretch = 0.8}};
  Simulation simulation(settings);
  while (simulation.time() < 1) {
    if (!simulation.step().converged) continue;  // no shape satisfies the limits: reported
    const Extremes e = extremes(settings.cloth, simulation.state().x);
    EXPECT_LE(e.most, 1.05 * 1.001 + 1e-9) << "step " << simulation.state().step;
    EXPECT_GE(e.least, 0.8 * 0.999 - 1e-9) << "step " << simulation.state().step;
  }
}

// With pins too far apart no cloth satisfies the limit: every step reports it, and the motion stays finite.
TEST_P(StrainLimit, ReportsWhatItCannotHold) {
  SimulationSettings settings = setup(cloth_of(make_grid(4, 4), 1, 20, {0, 4, 20, 24}), GetParam(), step());
  settings.effects = {drape::StrainLimit{.max_stretch = 1.1, .iterations = 50}};
  Simulation simulation(settings);
  State apart = simulation.state();
  apart.x *= 1.3;
  simulation.restore(apart);
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(simulation.step().converged);
  EXPECT_LT(simulation.state().x.norm(), 2 * apart.x.norm());
}

Eigen::RowVector3d momentum(const Cloth& cloth, const State& state) { return cloth.masses.transpose() * state.v; }
Eigen::RowVector3d angular_momentum(const Cloth& cloth, const State& state) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (int i = 0; i < cloth.vertex_count(); ++i) sum += cloth.masses[i] * state.x.row(i).cross(state.v.row(i));
  return sum;
}

// The filter alone acts on a free cloth that flies apart and turns. Semi-implicit Euler itself conserves both momenta.
TEST(StrainLimitAlone, KeepsBothMomentaOfAFreeCloth) {
  Cloth cloth = cloth_of(irregular_mesh(8), 1, 5, {});
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    cloth.masses[i] *= 1 + 0.5 * std::sin(i);
    const Eigen::RowVector3d x = cloth.positions.row(i);
    cloth.velocities.row(i) << 2 - 3 * x[1] + 2 * x[0], 1 + 3 * x[0] + 2 * x[1], -1 + std::sin(3 * x[0]);
  }
  SimulationSettings settings = setup(std::move(cloth), Method::semi_implicit, 0.002);
  settings.effects = {drape::StrainLimit{.max_stretch = 1.05}};
  Simulation simulation(settings);
  const Eigen::RowVector3d p = momentum(settings.cloth, simulation.state());
  const Eigen::RowVector3d l = angular_momentum(settings.cloth, simulation.state());
  ASSERT_GT(l.norm(), 0.1);
  constexpr int steps = 500;
  double most = 0;
  for (int i = 0; i < steps; ++i) {
    EXPECT_TRUE(simulation.step().converged);
    most = std::max(most, extremes(settings.cloth, simulation.state().x).most);
  }
  EXPECT_GT(most, 1.04) << "the limit was never felt";
  EXPECT_LE(most, 1.05 * 1.001 + 1e-9);
  EXPECT_LT((momentum(settings.cloth, simulation.state()) - p).norm(), 1e-12 * p.norm());
  EXPECT_LT((angular_momentum(settings.cloth, simulation.state()) - l).norm(), 1e-11 * l.norm());
}

/// A limit that stops stiff fabric: impulses at single vertices would store far more in the springs than they take.
class LimitOfStiffCloth : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, LimitOfStiffCloth,
                         testing::Values(NamedMethod{Method::implicit, "Implicit"}, NamedMethod{Method::liu13, "Liu13"},
                                         NamedMethod{Method::quasi_newton, "QuasiNewton"},
                                         NamedMethod{{Method::implicit, TimeScheme::sdirk2}, "ImplicitSdirk2"}),
                         method_name);

TEST_P(LimitOfStiffCloth, GivesItNoEnergy) {
  SimulationSettings settings = setup(cloth_of(make_grid(12, 12), 0.9, 4000, {0, 12}), GetParam(), 0.01);
  settings.effects = {Gravity{}, drape::StrainLimit{.max_stretch = 1.001}};
  Simulation simulation(settings);
  double least = simulation.energies().total(), rise = 0, stretch = 0;
  while (simulation.time() < 1.5) {
    const bool converged = simulation.step().converged;
    const double total = simulation.energies().total();
    rise = std::max(rise, total - least);
    least = std::min(least, total);
    if (converged) stretch = std::max(stretch, extremes(settings.cloth, simulation.state().x).most);
  }
  EXPECT_LE(rise, 0.01 * 0.9 * 9.8 * 1) << "of the fall by half of its length";
  EXPECT_LE(stretch, 1.001 * 1.001 + 1e-9);
}

/// Returns the mass-weighted distance that vertices are moved [√kg·m].
double way(const Cloth& cloth, const Vertices& from, const Vertices& to) {
  return std::sqrt(cloth.masses.dot((to - from).rowwise().squaredNorm()));
}

// A step ends at the nearest position without overlong edges, except for turning ones: no path from there to another
// such position leads back towards the unconstrained one (Kinderlehrer and Stampacchia 1980, theorem I.2.3).
TEST(StrainLimitAlone, FindsTheNearestPlaceWithinTheLimits) {
  for (int seed = 1; seed <= 6; ++seed) {
    const Cloth cloth = cloth_of(irregular_mesh(6 + 2 * seed), 1, 5, {0, 3});
    constexpr double limit = 1.02, h = 0.01;
    System system(cloth, h);
    drape::StrainLimit{.max_stretch = limit, .iterations = 20000, .tolerance = 1e-5}.install(system);
    const Vertices& x = cloth.positions;
    Vertices wanted = x + 0.05 * x;  // grows by a twentieth, with a random perturbation
    wanted += 0.004 * random_vertices(cloth.vertex_count(), seed);
    for (const int pin : cloth.pins) wanted.row(pin) = x.row(pin);
    Vertices v = (wanted - x) / h;
    system.filters.front()->apply(x, 0, h, v);
    ASSERT_TRUE(system.filters.front()->done()) << seed;
    const Vertices found = x + h * v;
    EXPECT_LE(extremes(cloth, found).most, limit * (1 + 1e-5) + 1e-9) << seed;
    const double taken = way(cloth, wanted, found);
    EXPECT_GT(taken, 1e-3) << seed;
    // The result is independent of the initial tensions.
    State state{.x = x, .v = v};
    state.restraint.tensions = 50 * random_vertices(std::ssize(cloth.springs), seed).col(0);
    system.begin(state);
    Vertices other_v = (wanted - x) / h;
    system.filters.front()->apply(x, 0, h, other_v);
    EXPECT_TRUE(system.filters.front()->done()) << seed;
    EXPECT_LT(way(cloth, found, x + h * other_v), 0.02 * taken) << seed;
    // All positions between the start and another admissible one are admissible.
    for (const double part : {0.0, 0.2, 0.5, 0.9}) {
      const Vertices other = x + part * (found - x);
      const Vertices back = wanted - found, there = other - found;
      const double product = cloth.masses.dot(back.cwiseProduct(there).rowwise().sum());
      EXPECT_LE(product, 0.02 * taken * way(cloth, found, other)) << seed << ", " << part;
    }
    // The impulses are minimal: with less of all of them an edge is too long.
    for (const double part : {0.9, 0.99}) {
      EXPECT_GT(extremes(cloth, wanted + part * (found - wanted)).most, limit * (1 + 1e-5)) << seed;
    }
  }
}

// A sheet of 160×160 cells hanging from two corners is pulled down and aside: its load must travel to the pins over
// some 250 edges.
TEST(StrainLimitAlone, SettlesAcrossAWideCloth) {
  const Cloth cloth = cloth_of(make_grid(160, 160), 1, 180, {0, 160});
  constexpr double limit = 1.01, h = 0.01, tolerance = 1e-3;
  System system(cloth, h);
  drape::StrainLimit{.max_stretch = limit, .iterations = 400, .tolerance = tolerance}.install(system);
  Vertices v = Vertices::Zero(cloth.vertex_count(), 3);
  v.col(1).setConstant(1);
  v.col(2).setConstant(-0.1);
  for (const int pin : cloth.pins) v.row(pin).setZero();
  system.filters.front()->apply(cloth.positions, 0, h, v);
  EXPECT_TRUE(system.filters.front()->done());
  EXPECT_LE(extremes(cloth, cloth.positions + h * v).most, limit * (1 + tolerance) + 1e-9);
}

// One spring, squeezed and pushed aside at once, is held by an impulse along its old direction, which has no torque;
// after a large turn, along its new direction.
TEST(StrainLimitAlone, HoldsASpringThatIsPushedAcross) {
  for (const Eigen::RowVector3d& pushed : {Eigen::RowVector3d(0.6, 0.25, 0), {0.7, 0, -0.3}, {0.3, 0.3, 0.1}}) {
    Cloth cloth;
    cloth.positions = cloth.rest = Vertices::Zero(2, 3);
    cloth.positions(0, 0) = 1;
    cloth.velocities = Vertices::Zero(2, 3);
    cloth.masses = Eigen::Vector2d(0.5, 2);
    cloth.springs = {{.i = 0, .j = 1, .rest_length = 1, .stiffness = 1e-9}};
    SimulationSettings settings = setup(cloth, Method::semi_implicit, 0.01);
    settings.cloth.velocities.row(0) = (pushed - cloth.positions.row(0)) / settings.step;
    settings.effects = {drape::StrainLimit{.min_stretch = 0.8}};
    Simulation simulation(settings);
    EXPECT_TRUE(simulation.step().converged) << pushed;
    const Eigen::RowVector3d d = simulation.state().x.row(0) - simulation.state().x.row(1);
    EXPECT_GE(d.norm(), 0.8 * 0.999) << pushed;
    EXPECT_LE(d.norm(), 1.1 * 1.001) << pushed;
    const bool turned = pushed[0] < 0.9 * pushed.norm();
    const Eigen::RowVector3d along = turned ? pushed.normalized() : Eigen::RowVector3d(1, 0, 0);
    const Eigen::RowVector3d change = d - pushed;
    EXPECT_LT((change - change.dot(along) * along).norm(), 1e-9) << pushed;
  }
}

// A cloth that hangs at its limits comes to rest. Its weight pulls at edges hundreds of times harder than their motion
// in a step: impulses along the old edge directions would shake it for ever.
TEST(StrainLimitAlone, RestsWhereItHangs) {
  SimulationSettings settings = setup(cloth_of(make_grid(20, 20), 1, 20, {0, 20}), Method::quasi_newton, 0.01);
  settings.effects = {Gravity{}, drape::StrainLimit{.max_stretch = 1.1}, Damping{.factor = 0.05}};
  Simulation simulation(settings);
  double fastest = 0;
  while (simulation.time() < 8) {
    EXPECT_TRUE(simulation.step().converged);
    const double squared = simulation.state().v.squaredNorm() / settings.cloth.vertex_count();
    if (simulation.time() > 7) fastest = std::max(fastest, std::sqrt(squared));
  }
  EXPECT_GT(extremes(settings.cloth, simulation.state().x).most, 1.099) << "the limit was not felt";
  EXPECT_LT(fastest, 0.002);
}

TEST(StrainLimitAlone, RefusesAClothThatStartsBeyondIt) {
  SimulationSettings settings = setup(cloth_of(make_grid(4, 4), 1, 20, {}), Method::liu13, 0.02);
  settings.cloth.positions.col(0) *= 1.3;
  const auto found = problems(drape::StrainLimit{.max_stretch = 1.1}, settings);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].starts_with("max_stretch: the cloth starts beyond the limit")) << found[0];
  EXPECT_TRUE(problems(drape::StrainLimit{.max_stretch = 1.4}, settings).empty());
  EXPECT_EQ(problems(drape::StrainLimit{.max_stretch = 2, .min_stretch = 1}, settings).size(), 0U);
  settings.cloth.positions.col(0) *= 0.5;
  EXPECT_EQ(problems(drape::StrainLimit{.max_stretch = 2, .min_stretch = 0.9}, settings).size(), 1U);
}

}  // namespace
}  // namespace drape::test
