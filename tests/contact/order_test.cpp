// Contact is right in the limit of short steps: falls on obstacles go to those of velocity Verlet with very short ones.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "tests/contact/contact_setup.hpp"

namespace drape::test {
namespace {

using Eigen::Vector3d;

class Order : public Solved {};
INSTANTIATE_TEST_SUITE_P(With, Order, testing::ValuesIn(solving_methods), method_name);

constexpr double fall_seconds = 0.08;  // before anything buckles

/// A sheet that arrives with 1 m/s.
/// @param tilt about the y axis [rad]
SimulationSettings arriving(const Effect& obstacle, double tilt) {
  Mesh mesh = level_square(0.6, 6, 0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(tilt, Vector3d::UnitY()).toRotationMatrix();
  mesh.positions = (mesh.positions * turn.transpose()).eval();
  mesh.positions.col(2).array() += distance + 0.02 - mesh.positions.col(2).minCoeff();
  SimulationSettings s{.cloth = plain_sheet(mesh, 60)};
  s.cloth.velocities.col(2).setConstant(-1);
  s.effects = {Gravity{}, obstacle};
  return s;
}

Vertices end_of(SimulationSettings s, Method method, double step) {
  s.step = step;
  s.integrator.method = method;
  s.integrator.stop = StoppingRule::error;
  s.integrator.tolerance = 1e-8;
  Simulation simulation(s);
  run(simulation, fall_seconds);
  return simulation.state().x;
}

TEST_P(Order, FallsGoToThoseOfVerletWithTheStep) {
  const Sphere ball{.center = Vector3d(0, 0, -0.2), .radius = 0.2, .thickness = distance, .friction = 0.3};
  const std::array<SimulationSettings, 3> falls{arriving(ball, 0), arriving(solved_box({0.3, 0.3, 0.2}, 0), 0),
                                                arriving(solved_ground(0.3), 0.4)};
  for (const SimulationSettings& s : falls) {
    const Vertices right = end_of(s, Method::verlet, 5e-5);
    std::array<double, 4> errors{};
    for (std::size_t k = 0; k < errors.size(); ++k) {
      const Vertices x = end_of(s, GetParam().method, 0.008 / std::exp2(static_cast<double>(k)));
      errors[k] = (x - right).norm() / std::sqrt(static_cast<double>(x.rows()));
      if (k > 0) {
        EXPECT_LT(errors[k], errors[k - 1]) << s.effects[1].name() << k;
      }
    }
    // Around the edges of a box it is 0.84: the contacts there are others in each step.
    const double order = s.effects[1].name() == Body::name ? 0.8 : 0.9;
    EXPECT_GE(std::log2(errors.front() / errors.back()) / 3, order)
        << s.effects[1].name() << " " << errors[0] << " " << errors[3];
  }
}

}  // namespace
}  // namespace drape::test
