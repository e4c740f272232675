#include "render/shadows.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "render/smooth_surface.hpp"
#include "tests/support/random.hpp"

namespace drape::test {
namespace {

using Eigen::Vector3d;

std::vector<AmbientOcclusion::Sides> open_sides(const Vertices& x, const std::vector<Triangle>& triangles,
                                                double texel = 0.02) {
  AmbientOcclusion occlusion;
  return occlusion.compute(x, vertex_normals(x, triangles), triangles, texel);
}

Eigen::Matrix3d some_rotation(std::uint64_t seed) {
  Random random(seed);
  Eigen::Vector4d q;
  for (int k = 0; k < 4; ++k) q[k] = random.between(-1, 1);
  return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}

/// Makes a sheet folded along the y axis to a dihedral angle that opens upwards, each side a metre wide.
Mesh folded(double angle) {
  Mesh mesh = make_grid(40, 40);
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    const double x = mesh.positions(i, 0);
    mesh.positions(i, 0) = std::sin(angle / 2) * x;
    mesh.positions(i, 2) = std::cos(angle / 2) * std::abs(x);
  }
  return mesh;
}

TEST(AmbientOcclusion, LeavesAFlatSheetAllOfTheLight) {
  const Mesh mesh = make_grid(12, 12);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Vertices x = mesh.positions * some_rotation(seed).transpose();
    for (const AmbientOcclusion::Sides& sides : open_sides(x, mesh.triangles)) {
      ASSERT_EQ(sides[0], 1) << "seed " << seed;
      ASSERT_EQ(sides[1], 1) << "seed " << seed;
    }
  }
}

// A wedge that opens by 2α around the normal admits sin α of the light with Lambert's cosine: the integral of its
// cosine over the wedge's directions, divided by that over the hemisphere. The outside of the fold sees its whole
// hemisphere.
TEST(AmbientOcclusion, LeavesTheInnerCornerOfAFoldTheLightOfItsWedge) {
  for (const double degrees : {40, 60, 90, 120, 150}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Mesh mesh = folded(angle);
    double inside = 0, outside = 0;
    constexpr int turns = 24;
    for (std::uint64_t seed = 1; seed <= turns; ++seed) {
      const auto sides = open_sides(mesh.positions * some_rotation(seed).transpose(), mesh.triangles);
      const AmbientOcclusion::Sides& corner = sides[20 * 41 + 20];
      inside += double{corner[0]} / turns;
      outside += double{corner[1]} / turns;
    }
    EXPECT_NEAR(inside, std::sin(angle / 2), 0.12) << degrees << " degrees";
    EXPECT_NEAR(outside, 1, 0.02) << degrees << " degrees";
  }
}

// It is dark between two wide sheets and bright on their outer sides, for upright sheets as for level ones.
TEST(AmbientOcclusion, TellsTheTwoSidesOfEachLayerApart) {
  const Mesh sheet = make_grid(20, 20);
  const int n = static_cast<int>(sheet.positions.rows());
  Vertices x(2 * n, 3);
  x << sheet.positions, sheet.positions.rowwise() + Eigen::RowVector3d(0, 0, 0.1);
  std::vector<Triangle> triangles = sheet.triangles;
  for (const Triangle& t : sheet.triangles) triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  for (const bool upright : {false, true}) {
    const Eigen::Matrix3d turn = upright
                                     ? Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX()).toRotationMatrix()
                                     : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
    const auto sides = open_sides(x * turn.transpose(), triangles);
    const std::size_t lower = 10 * 21 + 10, upper = lower + static_cast<std::size_t>(n);
    EXPECT_LT(sides[lower][0], 0.15);
    EXPECT_LT(sides[upper][1], 0.15);
    EXPECT_EQ(sides[lower][1], 1);
    EXPECT_EQ(sides[upper][0], 1);
  }
}

TEST(AmbientOcclusion, DoesNotFlickerWhenAClothMoves) {
  Mesh mesh = make_grid(20, 20);
  const auto at = [&](double shift) {
    Vertices x = mesh.positions;
    x.col(2) = 0.15 * (8 * x.col(0)).array().sin();
    x.col(0).array() += shift;
    return open_sides(x, mesh.triangles);
  };
  const auto before = at(0);
  for (int step = 1; step <= 10; ++step) {
    const auto after = at(0.003 * step);
    for (std::size_t i = 0; i < before.size(); ++i) {
      for (std::size_t side = 0; side < 2; ++side) ASSERT_NEAR(after[i][side], before[i][side], 0.12) << step;
    }
  }
}

}  // namespace
}  // namespace drape::test
