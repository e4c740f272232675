// Blocks of vertices that contact with a ball or a plane leaves out.

#include <gtest/gtest.h>

#include <cmath>

#include "sim/contact/contact.hpp"
#include "tests/support/random.hpp"

namespace drape::surface_block_test {
namespace {

constexpr double near = 0.02, distance = 0.01;

SurfaceBlock random_block(test::Random& random, const Eigen::RowVector3d& middle, double size) {
  SurfaceBlock block;
  for (Eigen::Index i = 0; i < block.rows(); ++i) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) block(i, axis) = middle[axis] + size * random.between(-1, 1);
  }
  return block;
}

/// Expects that no vertex of a block that is left out touches the surface, and that some blocks are left out.
template <class Placed>
void expect_only_clear_blocks_left_out(const Placed& surface) {
  test::Random random(3);
  int left_out = 0, touching = 0;
  for (int k = 0; k < 20000; ++k) {
    const Eigen::RowVector3d start(random.between(-2, 2), random.between(-2, 2), random.between(-2, 2));
    const Eigen::RowVector3d way(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    const SurfaceBlock from = random_block(random, start, 0.1);
    const double step = std::pow(random.between(0, 1), 3);
    const SurfaceBlock to = from + random_block(random, step * way, 0.005);
    bool touches = false;
    for (Eigen::Index i = 0; i < from.rows(); ++i) {
      const Eigen::Vector3d a = from.row(i).transpose(), b = to.row(i).transpose();
      touches = touches || surface.gap(b) < near || surface.crosses(a, b, distance);
    }
    touching += touches ? 1 : 0;
    if (!surface.stay_clear(from, to, near, distance)) continue;
    ++left_out;
    EXPECT_FALSE(touches) << k;
  }
  EXPECT_GT(left_out, 1000);
  EXPECT_GT(touching, 300);
}

TEST(SurfaceBlock, IsLeftOutOnlyFarFromABall) {
  BallObstacle::Placed ball;
  ball.radius = 0.5;
  expect_only_clear_blocks_left_out(ball);
}

TEST(SurfaceBlock, IsLeftOutOnlyFarFromAPlane) {
  PlaneObstacle::Placed plane;
  plane.up = Eigen::Vector3d(1, 2, 3).normalized();
  expect_only_clear_blocks_left_out(plane);
}

// A path through the middle of the ball: both ends are far away.
TEST(SurfaceBlock, IsNotLeftOutOnItsWayThroughABall) {
  BallObstacle::Placed ball;
  ball.radius = 0.5;
  SurfaceBlock from = SurfaceBlock::Zero(), to = SurfaceBlock::Zero();
  from.col(0).setConstant(-3);
  to.col(0).setConstant(3);
  EXPECT_FALSE(ball.stay_clear(from, to, near, distance));
}

}  // namespace
}  // namespace drape::surface_block_test
