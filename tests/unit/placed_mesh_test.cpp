// Closest points on a mesh, and the tree that finds them.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "drape/sim/effects/body.hpp"
#include "sim/collision/placed_mesh.hpp"

namespace drape::test {
namespace {

constexpr double anywhere = std::numeric_limits<double>::infinity();

PlacedMesh placed(const Mesh& mesh) {
  return {std::make_shared<MeshTopology>(mesh.triangles, static_cast<int>(mesh.positions.rows())), mesh.positions};
}

/// Returns the signed distance from a box around the origin.
double box_distance(const Point& half, const Point& p) {
  const Point d = p.cwiseAbs() - half;
  return d.cwiseMax(0).norm() + std::min(d.maxCoeff(), 0.0);
}

TEST(PlacedMesh, KnowsTheDistanceFromABoxAndTheWayOutOfIt) {
  const Point half(0.5, 0.3, 0.2);
  const PlacedMesh box = placed(make_box(2 * half));
  ASSERT_TRUE(box.solid());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int k = 0; k < 2000; ++k) {
    const Point p(place(random), place(random), place(random));
    const double expected = box_distance(half, p);
    const auto closest = box.find(p, anywhere);
    ASSERT_TRUE(closest);
    EXPECT_NEAR(closest->distance, expected, 1e-12);
    EXPECT_NEAR(closest->normal.norm(), 1, 1e-12);
    // A small step along the normal increases the distance by its length.
    EXPECT_NEAR(box_distance(half, p + 1e-6 * closest->normal), expected + 1e-6, 1e-9);
    const auto near = box.find(p, 0.1);
    EXPECT_TRUE(near.has_value() || expected > 0.1);
    if (near) {
      EXPECT_EQ(near->distance, closest->distance);
    }
  }
}

TEST(PlacedMesh, IsTheSameWhicheverTriangleIsLookedAtFirst) {
  const PlacedMesh box = placed(make_box({1, 1, 1}));
  std::mt19937 random(2);
  std::uniform_int_distribution<int> eighths(-8, 8);  // many points have several closest triangles
  for (int k = 0; k < 300; ++k) {
    const Point p(eighths(random) / 8.0, eighths(random) / 8.0, eighths(random) / 8.0);
    const auto plain = box.find(p, anywhere);
    for (int hint = 0; hint < 12; ++hint) {
      const auto hinted = box.find(p, anywhere, hint);
      EXPECT_EQ(hinted->triangle, plain->triangle);
      EXPECT_EQ(hinted->distance, plain->distance);
      EXPECT_EQ(hinted->normal, plain->normal);
    }
  }
}

TEST(PlacedMesh, IsNotAroundWhatIsBesideAFold) {
  // A bar along y, whose section ends in a point at x = 0, where its two sides have crossed.
  const std::array<std::array<double, 2>, 5> section{{{0, 0}, {1, 0.05}, {2, -1}, {2, 1}, {1, -0.05}}};  // x, z
  Mesh bar;
  bar.positions.resize(10, 3);
  for (int i = 0; i < 5; ++i) {
    const auto& [x, z] = section[static_cast<std::size_t>(i)];
    bar.positions.row(i) << x, -1, z;
    bar.positions.row(i + 5) << x, 1, z;
    const int j = (i + 1) % 5;
    bar.triangles.push_back({i, i + 5, j + 5});
    bar.triangles.push_back({i, j + 5, j});
  }
  for (int i = 1; i < 4; ++i) {
    bar.triangles.push_back({0, i, i + 1});
    bar.triangles.push_back({5, i + 6, i + 5});
  }
  const PlacedMesh mesh = placed(bar);
  ASSERT_TRUE(mesh.solid());
  const auto beside = mesh.find({-0.3, 0.1, 0.01}, anywhere);
  EXPECT_NEAR(beside->distance, std::hypot(0.3, 0.01), 1e-12);
  EXPECT_LT(beside->normal.x(), 0);
  EXPECT_LT(mesh.find({1.9, 0.1, 0.1}, anywhere)->distance, 0);
}

TEST(PlacedMesh, IsAShellUnlessItIsClosedAndRunsOneWay) {
  Mesh box = make_box({1, 1, 1});
  EXPECT_TRUE(placed(box).solid());
  Mesh open = box;
  open.triangles.pop_back();
  EXPECT_FALSE(placed(open).solid());
  Mesh twisted = box;
  std::swap(twisted.triangles[3][0], twisted.triangles[3][1]);
  EXPECT_FALSE(placed(twisted).solid());
  const auto inside = placed(open).find(Point(0, 0, 0.45), anywhere);
  EXPECT_NEAR(inside->distance, 0.05, 1e-15);
  EXPECT_LT(inside->normal.z(), 0);
}

TEST(TriangleTree, FindsAllThatOverlapsBeforeAndAfterItMoves) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1), size(0, 0.2);
  std::vector<Box> boxes(300);
  TriangleTree tree;
  for (int round = 0; round < 2; ++round) {
    for (Box& box : boxes) {
      box.min() = Point(place(random), place(random), place(random));
      box.max() = box.min() + Point(size(random), size(random), size(random));
    }
    if (round == 0) {
      tree.build(boxes);
    } else {
      tree.refit(boxes);
    }
    for (const Box& box : boxes) {
      std::vector<int> found, expected;
      tree.for_overlapping(box, [&](int k) {
        if (boxes[static_cast<std::size_t>(k)].intersects(box)) found.push_back(k);
      });
      for (int k = 0; k < 300; ++k) {
        if (boxes[static_cast<std::size_t>(k)].intersects(box)) expected.push_back(k);
      }
      std::ranges::sort(found);
      EXPECT_EQ(found, expected);
    }
  }
}

}  // namespace
}  // namespace drape::test
