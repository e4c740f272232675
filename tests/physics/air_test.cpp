#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "drape/sim/effects/air.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

class Air : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, Air, testing::ValuesIn(all_methods), method_name);

constexpr double density = 1.2, drag = 1.1, lift = 0.5;

drape::Air air(const Vector3d& velocity = Vector3d::Zero(), double gust = 0) {
  return {.velocity = velocity, .density = density, .drag = drag, .lift = lift, .gusts = {.speed = gust}};
}

/// Makes a flat sheet of 2 m × 2 m with masses proportional to the vertices' areas, so that air and gravity do not bend
/// it.
Cloth even_sheet(double mass) {
  Cloth cloth = cloth_of(make_grid(5, 5), 1, 40, {});
  cloth.masses.setZero();
  for (const Triangle& t : cloth.triangles) {
    for (const int vertex : t) cloth.masses[vertex] += mass / 3 / static_cast<double>(cloth.triangles.size());
  }
  return cloth;
}

RowVector3d mean_velocity(const State& state) { return state.v.colwise().mean(); }

TEST_P(Air, AFlatSheetFallsAtItsTerminalVelocity) {
  SimulationSettings settings = setup(even_sheet(0.4), GetParam(), 0.01);
  settings.effects = {Gravity{}, air()};
  Simulation simulation(settings);
  const double area = 4, terminal = std::sqrt(2 * 0.4 * 9.8 / (density * area * drag));
  for (int step = 0; step < 400; ++step) simulation.step();
  EXPECT_NEAR(mean_velocity(simulation.state())[2], -terminal, 1e-6 * terminal);
}

// m v̇ = m g − ρ A C v²/2, v(t) = v_∞ tanh(g t/v_∞)
TEST_P(Air, OnItsWayThereItFollowsTheHyperbolicTangent) {
  SimulationSettings settings = setup(even_sheet(0.4), GetParam(), 0.0005);
  settings.effects = {Gravity{}, air()};
  Simulation simulation(settings);
  const double terminal = std::sqrt(2 * 0.4 * 9.8 / (density * 4 * drag));
  for (int step = 0; step < 200; ++step) simulation.step();
  EXPECT_NEAR(mean_velocity(simulation.state())[2], -terminal * std::tanh(9.8 * 0.1 / terminal), 0.003);
}

/// Returns the force on an even sheet in a wind, by the change of its momentum in a very short step.
Vector3d force_in(const Vector3d& wind, const Vector3d& velocity, Method method) {
  SimulationSettings settings = setup(even_sheet(0.4), method, 1e-6);
  settings.cloth.velocities.rowwise() = velocity.transpose();
  settings.effects = {air(wind)};
  Simulation simulation(settings);
  simulation.step();
  const Vertices change = simulation.state().v - settings.cloth.velocities;
  return (settings.cloth.masses.transpose() * change).transpose() / settings.step;
}

TEST_P(Air, DragFollowsTheWindAndLiftIsAcrossIt) {
  const Method method = GetParam().method;
  for (const double angle : {0.0, 0.3, 0.7, 1.2, 2.5}) {  // between the wind and the sheet's normal, z
    const Vector3d wind = 3 * Vector3d(std::sin(angle), 0, std::cos(angle));
    const double c = std::cos(angle), pressure = density * 4 / 2 * 9;
    const Vector3d across = Vector3d::UnitZ() - c * wind / 3;
    const Vector3d expected = pressure * (drag * std::abs(c) * wind / 3 + lift * c * across);
    EXPECT_LT((force_in(wind, Vector3d::Zero(), method) - expected).norm(), 1e-3 * pressure) << angle;
    // Only the velocity relative to the cloth counts.
    const Vector3d drift(1, -2, 0.5);
    EXPECT_LT((force_in(wind + drift, drift, method) - expected).norm(), 1e-3 * pressure) << angle;
  }
}

TEST_P(Air, WithoutWindAndMotionItDoesNothing) {
  EXPECT_EQ(force_in(Vector3d::Zero(), Vector3d::Zero(), GetParam().method), Vector3d::Zero());
  // An implicit method may add only the rounding of positions, divided twice by the very short step.
  EXPECT_LT(force_in({2, 1, 0}, {2, 1, 0}, GetParam().method).norm(), 1e-4);
}

double kinetic(const State& state, const Eigen::VectorXd& masses, const Vector3d& wind) {
  return 0.5 * masses.dot((state.v.rowwise() - wind.transpose()).rowwise().squaredNorm());
}

// For any lightness, speed and step, the air brings the cloth at most to rest.
TEST(AirBound, NoStepRaisesTheKineticEnergyRelativeToTheWind) {
  const Vector3d wind(3, -1, 2);
  for (const double h : {0.001, 0.02, 1.0, 100.0}) {
    SimulationSettings settings = setup(cloth_of(make_grid(6, 6), 1e-3, 1, {}), Method::semi_implicit, h);
    settings.cloth.springs.clear();
    settings.cloth.positions += 0.1 * random_vertices(49, 4);
    settings.cloth.velocities = 30 * random_vertices(49, 5);
    settings.effects = {air(wind)};
    double before = kinetic({.x = {}, .v = settings.cloth.velocities}, settings.cloth.masses, wind);
    Simulation simulation(settings);
    for (int step = 0; step < 5; ++step) {
      // Starts from the same shape every time: a long step would carry the vertices away.
      State state = simulation.state();
      state.x = settings.cloth.positions;
      simulation.restore(state);
      simulation.step();
      const double after = kinetic(simulation.state(), settings.cloth.masses, wind);
      EXPECT_LE(after, before * (1 + 1e-12)) << h;
      before = after;
    }
  }
}

// With any of its vertices held: those need not be stopped.
TEST(AirBound, OneTriangleIsStoppedAndNotBlownBack) {
  Cloth cloth;
  cloth.positions.resize(3, 3);
  cloth.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  cloth.velocities = RowVector3d(0, 0, -5).replicate(3, 1);
  cloth.triangles = {{0, 1, 2}};
  cloth.masses = Eigen::VectorXd::Constant(3, 1e-6);
  for (const std::vector<int>& pins : {std::vector<int>{}, {0}, {0, 2}}) {
    cloth.pins = pins;
    SimulationSettings settings = setup(cloth, Method::semi_implicit, 1);
    settings.effects = {air()};
    Simulation simulation(settings);
    simulation.step();
    EXPECT_LT(simulation.state().v.norm(), 1e-14) << pins.size() << " pins";
  }
}

TEST_P(Air, GustsBlowTheSameWayEveryTime) {
  SimulationSettings settings = setup(cloth_of(make_grid(6, 6), 0.3, 40, {0, 6}), GetParam(), 0.005);
  settings.effects = {Gravity{}, air({4, 0, 0}, 2)};
  Simulation a(settings), b(settings);
  for (int step = 0; step < 40; ++step) {
    a.step();
    if (step == 20) b.restore(a.state());
    if (step > 20) b.step();
  }
  EXPECT_TRUE(same_bits(a.state().x, b.state().x));
  settings.effects = {Gravity{}, air({4, 0, 0}, 0)};
  Simulation steady(settings);
  for (int step = 0; step < 40; ++step) steady.step();
  EXPECT_GT((steady.state().x - a.state().x).norm(), 1e-3);
}

TEST(AirChecks, LiftNeedsDrag) {
  const SimulationSettings settings = setup(even_sheet(1), Method::liu13, 0.01);
  EXPECT_EQ(problems(drape::Air{.drag = 0}, settings).size(), 1U);
  EXPECT_TRUE(problems(drape::Air{.drag = 0, .lift = 0}, settings).empty());
}

}  // namespace
}  // namespace drape::test
