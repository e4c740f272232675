// Obstacles and pins that move: they give no more energy than they carry, and go exactly where they are told.

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>
#include <vector>

#include "drape/sim/effects/moving_pins.hpp"
#include "drape/sim/effects/strain_limit.hpp"
#include "tests/contact/contact_setup.hpp"
#include "tests/support/audited_run.hpp"

namespace drape::test {
namespace {

class Moving : public Solved {};
INSTANTIATE_TEST_SUITE_P(With, Moving, testing::ValuesIn(contact_methods), method_name);

/// Makes a square that is turned about the x axis, then about the y axis [rad].
Mesh tilted_square(double side, int cells, double about_x, double about_y, double height) {
  Mesh mesh = level_square(side, cells, 0);
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(about_x, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(about_y, Eigen::Vector3d::UnitY()))
          .toRotationMatrix();
  mesh.positions = (mesh.positions * turn).eval();
  mesh.positions.col(2).array() += height;
  return mesh;
}

// A step that does not converge may not take energy from an obstacle that hardly moves.
TEST_P(Moving, ASlowObstacleGivesNoEnergyToUnsolvedSteps) {
  for (const double speed : {0.0, 1e-9}) {
    Mesh mesh = level_square(1, 8, 0);
    mesh.positions = (mesh.positions * Eigen::AngleAxisd(0.4, Eigen::Vector3d(0.8, 0.6, 0)).toRotationMatrix()).eval();
    mesh.positions.col(2).array() += 0.02 - mesh.positions.col(2).minCoeff();
    SimulationSettings s = settings(make_cloth(mesh, mesh, 0.1, 1e6, {}), 0.04);
    s.cloth.velocities.col(2).setConstant(-3);
    Body body = solved_box({1, 1, 0.4}, 0);
    body.friction = 1.5;
    if (speed > 0) body.velocity = Eigen::Vector3d(0, 0, speed);
    s.effects = {body};
    s = divided(s);
    Simulation simulation(s);
    const double start = simulation.energies().total();
    double most = start;
    for (int step = 0; step < 25; ++step) {
      simulation.step();
      most = std::max(most, simulation.energies().total());
    }
    EXPECT_LE(most, 1.05 * start) << speed;
  }
}

// Too few iterations: what a step gains does not depend on the speed of all.
TEST_P(Moving, UnsolvedStepsGainNoMoreInAFrameThatMoves) {
  if (is_explicit(GetParam().method)) GTEST_SKIP() << "explicit methods do not iterate";
  for (const double speed : {0.0, 10.0, 40.0}) {
    const Mesh mesh = tilted_square(0.8, 7, 0.26, 0.44, 0.35);
    SimulationSettings s = settings(make_cloth(mesh, mesh, 0.2, 2000, {}), 0.01);
    s.integrator.max_iterations = 4;
    s.cloth.velocities.col(0).setConstant(speed);
    Body body = solved_box({3, 3, 0.2}, -0.1);
    body.friction = 0.3;
    body.velocity = Eigen::Vector3d(speed, 0, 0);
    s.effects.add(body);
    Simulation simulation(s);
    const auto total = [&] {
      const Energies now = simulation.energies();
      const Eigen::RowVector3d boost(speed, 0, 0);
      return now.total() - s.cloth.masses.dot(simulation.state().v * boost.transpose()) +
             0.5 * s.cloth.masses.sum() * speed * speed;
    };
    const double start = total();
    double most = start;
    for (int step = 0; step < 60; ++step) {
      simulation.step();
      most = std::max(most, total());
    }
    EXPECT_LE(most, 1.02 * start) << speed;
  }
}

/// A sphere around the origin that grows by `speed` until `end`.
class GrowingSphere final : public SphereTrack {
 public:
  static constexpr double first = 0.2, speed = 1, end = 0.2;  // [m], [m/s], [s]

  [[nodiscard]] SphereShape at(double time) const override {
    const double radius = first + speed * std::min(time, end);
    return {.radius = radius, .reach = radius + distance};
  }
};

// A sheet on it rises with its surface, and flies on at that speed once it stops.
TEST_P(Moving, AGrowingSphereCarriesWhatLiesOnIt) {
  SimulationSettings s = settings(plain_sheet(level_square(0.05, 2, GrowingSphere::first + distance), 50), 0.01);
  s.effects = {Sphere{.thickness = distance, .track = std::make_shared<GrowingSphere>()}};
  s = divided(s);
  Simulation simulation(s);
  const auto speed = [&] { return mean_of(s.cloth, simulation.state().v).z(); };
  run(simulation, 0.15);
  EXPECT_NEAR(speed(), GrowingSphere::speed, 0.05);
  run(simulation, 0.5);
  EXPECT_NEAR(speed(), GrowingSphere::speed, 0.05);
}

// Pins that pull a stiff cloth tight over a box: most steps cannot be solved, but the pins are where they have to be.
TEST_P(Moving, PinsGoWhereTheyAreToldAcrossAnObstacle) {
  Cloth cloth = make_cloth(make_grid(6, 6), make_grid(6, 6), 1, 20000, {});
  for (int row = 0; row <= 6; ++row) {
    for (const int pin : {7 * row, 7 * row + 6}) cloth.pins.push_back(pin);
  }
  cloth.positions.col(2).setConstant(0.3);
  SimulationSettings s = settings(std::move(cloth), 0.02);
  Body box = solved_box({0.5, 0.5, 0.5}, 0.25);
  box.center = Eigen::Vector3d(0.3, 0, 0);
  s.effects.add(box);
  s.effects.add(MovingPins{.pins = s.cloth.pins, .keyframes = {{.time = 0.2, .value = {0, 0, -1}}}});
  s = divided(s);
  Simulation simulation(s);
  for (int step = 1; step <= 12; ++step) {
    simulation.step();
    const double height = 0.3 - std::min(1.0, step * s.step / 0.2);
    for (const int pin : s.cloth.pins) {
      EXPECT_NEAR(simulation.state().x(pin, 2), height, 1e-12) << "step " << step << ", pin " << pin;
    }
  }
  // Impulses hold what collides as one rigid body, from which pins depart.
  if (is_explicit(s.integrator.method)) return;
  EXPECT_EQ(audit_run(s, 12).with_passages, 0);
}

/// Returns the positions after some steps relative to a frame that moves upwards at `speed`, and the steps that did not
/// converge.
std::pair<Vertices, int> in_frame(SimulationSettings settings, double speed, int steps) {
  settings.cloth.velocities.col(2).array() += speed;
  const double duration = steps * settings.step;
  if (speed != 0) {
    settings.effects.add(MovingPins{.pins = settings.cloth.pins,
                                    .keyframes = {{.time = 2 * duration, .value = {0, 0, 2 * duration * speed}}}});
  }
  Simulation simulation(settings);
  int unsolved = 0;
  for (int step = 0; step < steps; ++step) unsolved += simulation.step().converged ? 0 : 1;
  Vertices x = simulation.state().x;
  x.col(2).array() -= duration * speed;
  return {x, unsolved};
}

/// Expects the same motion in a frame at rest and in one that moves, as Galileo says.
void expect_same_in_moving_frame(const SimulationSettings& settings, int steps, double tolerance) {
  const auto [at_rest, unsolved] = in_frame(settings, 0, steps);
  for (const double speed : {2.0, -1.0}) {
    const auto [moving, left] = in_frame(settings, speed, steps);
    EXPECT_LT((moving - at_rest).cwiseAbs().maxCoeff(), tolerance) << speed;
    EXPECT_LE(left, unsolved + 1) << speed;
  }
}

// A sheet falls on a plate that pins hold or carry.
TEST_P(Moving, PinsCarryClothThatLiesOnThem) {
  Mesh sheet = level_square(1, 6, 0.05);
  sheet.positions.col(0).array() += 0.1;
  const Mesh plate = level_square(2, 4, 0), both = together({plate, sheet});
  std::vector<int> pins;
  for (int i = 0; i < plate.positions.rows(); ++i) pins.push_back(i);
  SimulationSettings s = settings(make_cloth(both, both, 0.4, 50, pins), 0.005);
  s.cloth.velocities.bottomRows(sheet.positions.rows()).col(2).setConstant(-3);
  s.effects.add(SelfCollision{});
  expect_same_in_moving_frame(exact(divided(s)), 40, 1e-5);
}

// A cloth hangs from pins at its strain limit.
TEST_P(Moving, PinsPullClothAtItsStrainLimit) {
  Mesh mesh = make_grid(8, 8);
  mesh.positions.col(2).swap(mesh.positions.col(1));
  std::vector<int> pins;
  for (int i = 72; i < 81; ++i) pins.push_back(i);
  SimulationSettings s = settings(make_cloth(mesh, mesh, 0.4, 40, pins), 0.005);
  s.effects.add(StrainLimit{.max_stretch = 1.05});
  expect_same_in_moving_frame(exact(divided(s)), 30, 1e-3);
}

// A box flies through a sheet's place: the sheet is taken along, whatever its vertices do to each other.
TEST_P(Moving, ABodyTakesClothAlongThatTouchesItself) {
  const Mesh mesh = tilted_square(0.8, 8, 0.17, 0.09, 0.6);
  SimulationSettings s = settings(make_cloth(mesh, mesh, 0.2, 50, {}), 0.005);
  Body box = solved_box({0.3, 0.3, 0.1}, 0.05);
  box.velocity = Eigen::Vector3d(0, 0, 1);
  s.effects.add(SelfCollision{.thickness = 0.015});
  s.effects.add(box);
  const AuditedRun found = audit_run(divided(s), 100);
  EXPECT_EQ(found.with_crossings, 0) << (found.first.empty() ? "" : found.first.front());
}

// Cloth that falls at the speed of the body below it, and comes to rest on it.
TEST_P(Moving, ADescendingBodyLeavesStepsSolved) {
  SimulationSettings s = settings(plain_sheet(level_square(0.6, 8, 0.11), 60), 0.01);
  s.cloth.velocities.col(2).setConstant(-1);
  Body box = solved_box({2, 2, 0.2}, 0);
  box.velocity = Eigen::Vector3d(0, 0, -1);
  s.effects.add(box);
  s = divided(s);
  Simulation simulation(s);
  int unsolved = 0;
  for (int step = 0; step < 50; ++step) unsolved += simulation.step().converged ? 0 : 1;
  EXPECT_LE(unsolved, 2);
}

}  // namespace
}  // namespace drape::test
