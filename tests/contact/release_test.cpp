// Contact pushes and never pulls: a cloth pulled from an obstacle leaves it at once.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drape/sim/effects/acceleration.hpp"
#include "tests/contact/contact_setup.hpp"

namespace drape::test {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

class Release : public Solved {};
INSTANTIATE_TEST_SUITE_P(With, Release, testing::ValuesIn(contact_methods), method_name);

constexpr double net = 10;    // net upward acceleration [m/s²]
constexpr double lies = 0.1;  // time before the release [s]

/// Checks a sheet that rests on an obstacle until a field lifts it.
void expect_to_leave(SimulationSettings settings, const std::string& what) {
  settings.effects.add(Field{.acceleration = {"0", "0", "t > 0.0999 ? 19.8 : 0"}});
  Simulation simulation(settings);
  run(simulation, lies);
  EXPECT_NEAR(simulation.state().x.col(2).minCoeff(), distance, g * settings.step * settings.step) << what;
  const Eigen::VectorXd lay = simulation.state().x.col(2);
  const double way = net * settings.step * settings.step;  // of the first step
  simulation.step();
  simulation.step();
  EXPECT_GT((simulation.state().x.col(2) - lay).minCoeff(), 0.5 * way) << what;
  constexpr double rises = 0.3;
  run(simulation, lies + rises);
  const double right = 0.5 * net * rises * rises;
  const double risen =
      mean_of(simulation.cloth(), simulation.state().x).z() - mean_of(simulation.cloth(), settings.cloth.positions).z();
  EXPECT_NEAR(risen, right, net * rises * settings.step + 0.01 * right) << what;
}

TEST_P(Release, ASheetThatIsLiftedLeavesTheGroundAndABoxWithinTwoSteps) {
  for (const double step : {0.002, 0.01}) {
    for (const double restitution : {0.0, 0.5}) {
      const std::string what = std::to_string(step) + ", restitution " + std::to_string(restitution);
      SimulationSettings ground = settings(plain_sheet(level_square(0.5, 5, distance)), step), box = ground;
      ground.effects.add(solved_ground(0.5, restitution));
      expect_to_leave(ground, "ground, " + what);
      Body body = solved_box({0.8, 0.8, 0.2}, 0);
      body.restitution = restitution;
      box.effects.add(body);
      expect_to_leave(box, "box, " + what);
    }
  }
}

// The residual force includes contact forces, which bear the whole weight here.
TEST_P(Release, ASheetThatLiesIsInBalance) {
  SimulationSettings s = settings(plain_sheet(level_square(0.5, 5, distance + 0.002)), 0.01);
  s.effects.add(solved_ground());
  Simulation simulation(s);
  run(simulation, 0.5);
  if (GetParam().is_explicit()) return;  // explicit methods have no residual
  EXPECT_LT(simulation.residual_force(), 0.01 * simulation.weight());
  EXPECT_LT(simulation.residual(), 0.01 * simulation.weight());
  EXPECT_LT(simulation.error(), 1e-4);
}

constexpr double radius = 0.5, reach = radius + distance;  // of a ball around the origin [m]
constexpr double from_top = 5;                             // start of sliding [degrees]

/// Returns the angle from the top at which a body sliding off a frictionless ball loses contact: its acceleration is
/// then that of gravity [degrees].
double leaving_angle(SimulationSettings settings) {
  settings.effects.add(Sphere{.center = Vector3d(0, 0, 0), .radius = radius, .thickness = distance});
  Simulation simulation(settings);
  const Cloth& cloth = settings.cloth;
  double angle = 0;
  while (simulation.time() < 2 && angle < 90) {
    const RowVector3d before = mean_of(cloth, simulation.state().v);
    simulation.step();
    const RowVector3d x = mean_of(cloth, simulation.state().x);
    angle = std::atan2(x.head<2>().norm(), x.z()) * 180 / std::numbers::pi;
    const RowVector3d held = (mean_of(cloth, simulation.state().v) - before) / settings.step + RowVector3d(0, 0, g);
    if (held.norm() < 0.01 * g) break;
  }
  return angle;
}

/// Returns the exact angle of a point, whose weight along the normal, g cos θ, is then v²/R = 2g (cos θ₀ − cos θ)
/// [degrees].
double right_angle() { return std::acos(2 * std::cos(from_top * std::numbers::pi / 180) / 3) * 180 / std::numbers::pi; }
/// Returns the angle that it moves in a step there [degrees].
double angle_of_step(double step) { return std::sqrt(2 * g * reach / 3) * step / reach * 180 / std::numbers::pi; }

TEST_P(Release, APointLeavesABallWhereItsWeightIsTooSmallToHoldIt) {
  const double start = from_top * std::numbers::pi / 180;
  Cloth point;
  point.positions = point.rest = reach * RowVector3d(std::sin(start), 0, std::cos(start));
  point.velocities = RowVector3d::Zero();
  point.masses.setConstant(1, 0.1);
  for (const double step : {0.001, 0.002, 0.005}) {
    EXPECT_NEAR(leaving_angle(settings(point, step)), right_angle(), 0.2 + angle_of_step(step)) << step;
  }
}

TEST_P(Release, ASmallPatchLeavesABallWhereAPointDoes) {
  const double start = from_top * std::numbers::pi / 180;
  Mesh mesh = level_square(0.04, 2, 0);
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    // Wraps the sheet around the ball.
    const double a = start + mesh.positions(i, 0) / reach, b = mesh.positions(i, 1) / reach;
    mesh.positions.row(i) = reach * RowVector3d(std::sin(a) * std::cos(b), std::sin(b), std::cos(a) * std::cos(b));
  }
  for (const double step : {0.001, 0.002, 0.005}) {
    EXPECT_NEAR(leaving_angle(settings(plain_sheet(mesh, 1800), step)), right_angle(), 1 + angle_of_step(step)) << step;
  }
}

}  // namespace
}  // namespace drape::test
