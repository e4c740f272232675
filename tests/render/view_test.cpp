#include "drape/render/view.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

namespace drape {
namespace {

Vertices random_points(unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  Vertices points(50, 3);
  for (double& value : points.reshaped()) value = coordinate(generator);
  points.col(2) *= 0.3;
  return points.rowwise() + Eigen::RowVector3d(3, -7, 2);
}

struct Extent {
  Eigen::Vector2d lowest{1e9, 1e9}, highest{-1e9, -1e9};
  void add(const Eigen::Vector2d& p) {
    lowest = lowest.cwiseMin(p);
    highest = highest.cwiseMax(p);
  }
  /// Returns the largest distance from the middle of the picture, whose border is at 1.
  [[nodiscard]] double reach() const { return std::max(highest.maxCoeff(), -lowest.minCoeff()); }
};

Eigen::Vector2d project(const View& view, double aspect, const Eigen::Vector3d& p) {
  const Eigen::Vector4d clip = view.projection_matrix(aspect, {0.1, 100}) * view.view_matrix() * p.homogeneous();
  EXPECT_GT(clip[3], 0) << "behind the camera";
  return clip.head<2>() / clip[3];
}

Extent projected(const View& view, double aspect, const Vertices& points) {
  Extent extent;
  for (const auto& p : points.rowwise()) extent.add(project(view, aspect, p.transpose()));
  return extent;
}

TEST(Framing, LeavesExactlyTheMarginAtTheTightestSideAndCentresBothAxes) {
  for (const double aspect : {0.5, 1.2, 3.0}) {
    for (const double elevation : {-30.0, 20.0, 89.0}) {
      Camera camera;
      camera.elevation = elevation;
      camera.margin = 0.1;
      const Vertices points = random_points(static_cast<unsigned>(elevation + 100));
      Framing framing(camera, aspect);
      framing.add(points);
      const Extent extent = projected(framing.view(), aspect, points);
      EXPECT_NEAR(extent.reach(), 1 - 2 * camera.margin, 1e-9);
      EXPECT_NEAR(extent.highest.x() + extent.lowest.x(), 0, 0.04);
      EXPECT_NEAR(extent.highest.y() + extent.lowest.y(), 0, 0.04);
    }
  }
}

TEST(Framing, OfAMotionIsTheFramingOfAllItsFramesTogether) {
  const Vertices a = random_points(1), b = random_points(2).array() + 1.5;
  Framing framing(Camera{}, 1.2);
  framing.add(a);
  framing.add(b);
  const View view = framing.view();
  const double reach = std::max(projected(view, 1.2, a).reach(), projected(view, 1.2, b).reach());
  EXPECT_NEAR(reach, 1 - 2 * Camera{}.margin, 1e-9);
}

TEST(Framing, MayLeaveThePartOfTheFramesThatReachesFarthestOutside) {
  // Twenty frames in one place, and one far off to a side.
  const Vertices near = random_points(1), far = near.rowwise() + Eigen::RowVector3d(40, 0, 0);
  const auto view_of = [&](double outside) {
    Camera camera;
    camera.outside = outside;
    Framing framing(camera, 1.2);
    for (int frame = 0; frame < 21; ++frame) {
      framing.add(frame == 7 ? far : near);
      framing.end_frame();
    }
    return framing.view();
  };
  Framing alone(Camera{}, 1.2);
  alone.add(near);
  EXPECT_TRUE(view_of(0.05).position.isApprox(alone.view().position, 1e-9));
  EXPECT_NEAR(projected(view_of(0.05), 1.2, near).reach(), 1 - 2 * Camera{}.margin, 1e-9);
  EXPECT_LE(projected(view_of(0), 1.2, far).reach(), 1 - 2 * Camera{}.margin + 1e-9);
}

TEST(Framing, TouchesASphereFromOutside) {
  const SphereShape sphere{{1, 2, 3}, 0.7};
  Framing framing(Camera{}, 1.0);
  framing.add(Collider{sphere});
  const View view = framing.view();
  // The camera looks at the centre, from where the cone around the sphere has the free border's opening angle.
  const double distance = (view.position - sphere.center).norm();
  const double free = (1 - 2 * Camera{}.margin) * std::tan(view.field_of_view / 2 * M_PI / 180);
  EXPECT_NEAR(std::asin(sphere.radius / distance), std::atan(free), 1e-9);
  EXPECT_LT(project(view, 1.0, sphere.center).norm(), 1e-9);
}

TEST(Framing, LooksFromAzimuthAndElevation) {
  Camera camera;
  camera.azimuth = 90;
  camera.elevation = 30;
  Framing framing(camera, 1.0);
  framing.add(random_points(3));
  const View view = framing.view();
  EXPECT_TRUE((view.position - view.target)
                  .normalized()
                  .isApprox(Eigen::Vector3d(0, std::cos(M_PI / 6), std::sin(M_PI / 6)), 1e-12));
}

TEST(Framing, KeepsAGivenTargetInTheMiddle) {
  // Targets beside the points in every direction, so that each edge of the picture is binding for some of them.
  for (const Eigen::Vector3d& target :
       {Eigen::Vector3d(2.5, -7, 2), {5, -7, 2}, {3, -9, 2}, {3, -5, 2}, {3, -7, 4}, {3, -7, 0}}) {
    Camera camera;
    camera.target = target;
    const Vertices points = random_points(4);
    Framing framing(camera, 1.2);
    framing.add(points);
    const View view = framing.view();
    EXPECT_LT(project(view, 1.2, target).norm(), 1e-9) << target.transpose();
    EXPECT_NEAR(projected(view, 1.2, points).reach(), 1 - 2 * camera.margin, 1e-9) << target.transpose();
  }
}

TEST(Framing, TurnsACameraThatHasAPositionToTheMiddleOfTheMotion) {
  Camera camera;
  camera.position = Eigen::Vector3d(10, 0, 0);
  Vertices points(2, 3);
  points << 0, -1, -2, 2, 1, 4;
  Framing framing(camera, 1.2);
  framing.add(points);
  EXPECT_EQ(framing.view().position, *camera.position);
  EXPECT_EQ(framing.view().target, Eigen::Vector3d(1, 0, 1));
}

TEST(Framing, FromStraightAboveHasTheFarSideAtTheTop) {
  Camera camera;
  camera.azimuth = -90;
  camera.elevation = 90;
  Framing framing(camera, 1.0);
  framing.add(random_points(5));
  EXPECT_TRUE(framing.view().axes().isApprox(Eigen::Matrix3d::Identity(), 1e-9));
}

TEST(View, NeedsTheMotionUnlessPositionAndTargetAreGiven) {
  Camera camera;
  EXPECT_TRUE(needs_motion(camera));
  camera.position = Eigen::Vector3d(1, 2, 3);
  EXPECT_TRUE(needs_motion(camera));
  camera.target = Eigen::Vector3d(0, 0, 0);
  EXPECT_FALSE(needs_motion(camera));
  EXPECT_EQ(fixed_view(camera, {}).position, *camera.position);
}

TEST(View, IsTheSameWhereverOnItsAxisTheTargetLies) {
  Camera camera;
  camera.position = Eigen::Vector3d(0, -4, 1);
  const auto view_with = [&](double share) {
    camera.target = *camera.position + share * Eigen::Vector3d(0, 4, -1);
    return fixed_view(camera, make_grid(4, 4).positions);  // 2 m wide, about the origin
  };
  EXPECT_EQ(view_with(1).target, *camera.target);
  EXPECT_EQ(view_with(0.7).target, *camera.target);
  EXPECT_EQ(view_with(1.5).target, *camera.target);
  for (const double share : {0.01, 0.6, 1.6, 1e4}) {
    EXPECT_LT(view_with(share).target.norm(), 1e-12) << share;  // the middle of the cloth
  }
  camera.orbit = 360;  // circles the target
  EXPECT_EQ(view_with(0.01).target, *camera.target);
}

TEST(DepthRange, HoldsTheWholeFrame) {
  const View view{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 30};
  Frame frame;
  frame.positions = Vertices::Zero(2, 3);
  frame.positions(0, 2) = 1;
  frame.colliders.emplace_back(SphereShape{{0, 0, -2}, 1.5});
  const DepthRange depth = depth_range(view, frame);
  EXPECT_LT(depth.near, 4);
  EXPECT_GT(depth.near, 3.8);
  EXPECT_GT(depth.far, 8.5);
  EXPECT_LT(depth.far, 8.7);
}

}  // namespace
}  // namespace drape
