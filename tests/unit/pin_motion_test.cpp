// Turning pins, and pins attached to a mesh.

#include "drape/sim/tracks.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "sim/mesh_anchors.hpp"

namespace drape::pins_in_motion {
namespace {

using Eigen::Vector3d;

Vertices rows(std::initializer_list<Vector3d> points) {
  Vertices x(static_cast<Eigen::Index>(points.size()), 3);
  Eigen::Index i = 0;
  for (const Vector3d& point : points) x.row(i++) = point.transpose();
  return x;
}

/// Expects the velocity to be the limit of backward differences, also for motions with corners.
void expect_consistent(const PinMotion& motion, double from, double to) {
  const auto count = static_cast<Eigen::Index>(motion.vertices.size());
  Vertices before(count, 3), now(count, 3), v(count, 3), between(count, 3);
  constexpr double d = 1e-7;
  for (double time = from; time < to; time += 0.0317) {
    motion.place(time - d, before);
    motion.place(time, now);
    motion.drive(time, v);
    EXPECT_LT(((now - before) / d - v).cwiseAbs().maxCoeff(), 1e-4) << "at " << time;
    motion.drive(time - 0.1, time, between);
    motion.place(time - 0.1, before);
    EXPECT_LT((before + 0.1 * between - now).cwiseAbs().maxCoeff(), 1e-14) << "at " << time;
  }
}

TEST(PinMotion, TurnsAboutTheMiddleWhichMoves) {
  const Keyframes path({{0, {0, 0, 0}}, {2, {0, 0, 6}}}, Interpolation::linear);
  PinMotion motion{.vertices = {0, 1}, .base = rows({{2, 1, 0}, {0, 1, 0}}), .path = path};
  motion.turn = Keyframes({{0, {0, 0, 0}}, {2, {0, 0, 180}}}, Interpolation::linear);
  motion.middle = {1, 1, 0};
  Vertices x(2, 3);
  motion.place(1, x);
  EXPECT_TRUE(x.isApprox(rows({{1, 2, 3}, {1, 0, 3}}), 1e-14)) << x;
  // About the fixed x axis, then y, then z, as in [cloth.transform].
  motion.turn = Keyframes({{0, {90, 0, 90}}}, Interpolation::linear);
  motion.middle = {0, 1, 0};
  motion.base = rows({{0, 2, 0}, {1, 1, 0}});
  motion.place(0, x);
  EXPECT_TRUE(x.isApprox(rows({{0, 1, 1}, {0, 2, 0}}), 1e-14)) << x;
}

TEST(PinMotion, TurnsWithTheVelocityOfItsPlaces) {
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::smooth}) {
    PinMotion motion{.vertices = {0, 1}, .base = rows({{2, 1, 0.5}, {0, -1, 0}})};
    motion.path = Keyframes({{0, {0, 0, 0}}, {1, {1, 0, 2}}, {2, {0, 3, 0}}}, interpolation);
    motion.turn = Keyframes({{0, {0, 0, 0}}, {0.7, {40, -300, 20}}, {2, {10, 30, 720}}}, interpolation);
    motion.middle = {0.3, 0.1, 0};
    expect_consistent(motion, 0.05, 2.5);
  }
}

/// Makes a square of two triangles that lies still, then turns by 90° about y and rises.
MeshMotion flap() {
  MeshMotion motion{.mesh = make_grid(1, 1)};
  motion.times = {0, 1, 2};
  Vertices risen = motion.mesh.positions;
  risen.col(2) = -risen.col(0).array() + 5;
  risen.col(0).setZero();
  motion.samples = {motion.mesh.positions, motion.mesh.positions, risen};
  return motion;
}

TEST(MeshAnchors, KeepTheirPlaceBesideTheNearestTriangle) {
  // Above the surface, beside its edge, and on a corner.
  const Vertices points = rows({{0.5, -0.4, 0.2}, {1.5, 0.3, 0}, {-1, -1, 0}});
  const MeshAnchors anchors(flap(), points, 0);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_TRUE(anchors.at(k, 0.5).position.isApprox(Vector3d(points.row(static_cast<Eigen::Index>(k))), 1e-14));
    EXPECT_EQ(anchors.at(k, 0.5).velocity, Vector3d::Zero());
  }
  // Turned, (x, y, z) is at (z, y, 5 − x).
  EXPECT_TRUE(anchors.at(0, 2).position.isApprox(Vector3d(0.2, -0.4, 4.5), 1e-14));
  EXPECT_TRUE(anchors.at(1, 3).position.isApprox(Vector3d(0, 0.3, 3.5), 1e-14));
  EXPECT_TRUE(anchors.at(2, 9).position.isApprox(Vector3d(0, -1, 6), 1e-14));
}

TEST(MeshAnchors, HaveTheVelocityOfTheirPlaces) {
  PinMotion motion{.vertices = {0, 1}, .base = rows({{0.5, -0.4, 0.2}, {1.5, 0.3, -0.1}})};
  motion.anchors = std::make_shared<MeshAnchors>(flap(), motion.base, 0);
  expect_consistent(motion, 0.02, 2.4);
}

TEST(MeshAnchors, DoNotLeaveAMeshThatStandsStillOrHasNoArea) {
  MeshMotion flat{.mesh = make_grid(1, 1)};
  const MeshAnchors still(flat, rows({{0, 0, 3}}), 0);
  EXPECT_EQ(still.at(0, 7).position, Vector3d(0, 0, 3));
  flat.mesh.positions.col(1).setZero();
  EXPECT_THROW(MeshAnchors(flat, rows({{0, 0, 3}}), 0), std::invalid_argument);
}

}  // namespace
}  // namespace drape::pins_in_motion
