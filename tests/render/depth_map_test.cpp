#include "render/shadows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/random.hpp"

namespace drape::test {
namespace {

using Eigen::Vector3d;

DepthMap seen(const Mesh& mesh, const Vector3d& towards, double texel = 0.01, int largest = 1024) {
  DepthMap map;
  const bool along_z = towards.head<2>().isZero();
  map.look(towards.normalized(), along_z ? Vector3d::UnitY() : Vector3d::UnitZ());
  map.draw(mesh.positions, mesh.triangles, texel, largest);
  return map;
}

std::size_t index(const DepthMap& map, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(map.columns()) + static_cast<std::size_t>(column);
}

bool is_covered(const DepthMap& map, int column, int row) {
  return map.nearest()[index(map, column, row)] >= map.farthest()[index(map, column, row)];
}

/// Makes a grid with inner vertices shifted randomly in its plane: its triangles still tile the square.
Mesh shuffled(int cells, std::uint64_t seed) {
  Mesh mesh = make_grid(cells, cells);
  Random random(seed);
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    if (mesh.positions.row(i).cwiseAbs().maxCoeff() > 0.999) continue;
    for (int axis = 0; axis < 2; ++axis) mesh.positions(i, axis) += random.between(-0.4, 0.4) / cells;
  }
  return mesh;
}

TEST(DepthMap, HasNoGapBetweenTrianglesAndEndsWithThem) {
  const DepthMap map = seen(shuffled(40, 3), {0, 0, 1}, 0.0073);
  int covered = 0;
  for (int row = 0; row < map.rows(); ++row) {
    for (int column = 0; column < map.columns(); ++column) {
      const double x = (column + 0.5 - map.u()[3]) * 0.0073, y = (row + 0.5 - map.v()[3]) * 0.0073;
      const bool inside = std::max(std::abs(x), std::abs(y)) < 1;
      ASSERT_EQ(is_covered(map, column, row), inside) << x << ", " << y;
      covered += inside ? 1 : 0;
    }
  }
  EXPECT_NEAR(covered * 0.0073 * 0.0073, 4, 0.05);
}

TEST(DepthMap, KnowsTheDepthsOfTheNearestAndTheFarthestPiece) {
  // Two planes, z = 0.3 x + 0.2 y and one a metre below it.
  Mesh mesh = make_grid(3, 5);
  const Eigen::Index n = mesh.positions.rows();
  Vertices both(2 * n, 3);
  mesh.positions.col(2) = 0.3 * mesh.positions.col(0) + 0.2 * mesh.positions.col(1);
  both << mesh.positions, mesh.positions.rowwise() - Eigen::RowVector3d(0, 0, 1);
  const std::vector<Triangle> upper = mesh.triangles;
  for (const Triangle& t : upper) {
    const int offset = static_cast<int>(n);
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  mesh.positions = both;
  const DepthMap map = seen(mesh, {0, 0, 1});
  for (int row = 0; row < map.rows(); ++row) {
    for (int column = 0; column < map.columns(); ++column) {
      if (!is_covered(map, column, row)) continue;
      const double x = (column + 0.5 - map.u()[3]) * 0.01, y = (row + 0.5 - map.v()[3]) * 0.01;
      const double depth = 0.3 * x + 0.2 * y + map.depth()[3];
      ASSERT_NEAR(map.nearest()[index(map, column, row)], depth, 1e-5);
      ASSERT_NEAR(map.farthest()[index(map, column, row)], depth - 1, 1e-5);
    }
  }
}

TEST(DepthMap, ItsTexelsStayWhereTheyAreWhenTheClothGrows) {
  Mesh mesh = shuffled(8, 5);
  const Vector3d towards(0.4, -0.7, 0.6);
  const DepthMap before = seen(mesh, towards);
  const Eigen::Index n = mesh.positions.rows();
  mesh.positions.conservativeResize(n + 3, 3);
  mesh.positions.bottomRows(3) << 3, 3.1, -2, 3.2, 3.1, -2, 3.2, 3.5, -2;
  const int first = static_cast<int>(n);
  mesh.triangles.push_back({first, first + 1, first + 2});
  const DepthMap after = seen(mesh, towards);
  const double right = after.u()[3] - before.u()[3], up = after.v()[3] - before.v()[3];
  EXPECT_EQ(right, std::round(right));
  EXPECT_EQ(up, std::round(up));
  const auto deeper = static_cast<float>(after.depth()[3] - before.depth()[3]);
  for (int row = 0; row < before.rows(); ++row) {
    for (int column = 0; column < before.columns(); ++column) {
      if (!is_covered(before, column, row)) continue;
      const std::size_t same = index(after, column + static_cast<int>(right), row + static_cast<int>(up));
      ASSERT_NEAR(after.nearest()[same], before.nearest()[index(before, column, row)] + deeper, 1e-5);
    }
  }
}

TEST(DepthMap, OfAMirrorImageIsAMirrorImage) {
  Mesh mesh = shuffled(7, 9);
  mesh.positions.col(2) = 0.3 * (3 * mesh.positions.col(0)).array().sin();
  Mesh mirrored = mesh;
  mirrored.positions.col(0) *= -1;
  const DepthMap one = seen(mesh, {0.5, -0.6, 0.7}), other = seen(mirrored, {-0.5, -0.6, 0.7});
  ASSERT_EQ(one.columns(), other.columns());
  ASSERT_EQ(one.rows(), other.rows());
  for (int row = 0; row < one.rows(); ++row) {
    for (int column = 0; column < one.columns(); ++column) {
      const int opposite = one.columns() - 1 - column;
      ASSERT_EQ(is_covered(one, column, row), is_covered(other, opposite, row));
      ASSERT_NEAR(one.nearest()[index(one, column, row)], other.nearest()[index(other, opposite, row)], 1e-5);
    }
  }
}

TEST(DepthMap, IsNeverLargerThanItMayBeAndEmptyWhereTheClothHasNoPlace) {
  Mesh mesh = make_grid(4, 4);
  mesh.positions *= 1000;
  const DepthMap large = seen(mesh, {0, 0, 1});
  EXPECT_LE(std::max(large.columns(), large.rows()), 1024);
  EXPECT_GT(large.columns(), 256);
  EXPECT_TRUE(is_covered(large, large.columns() / 2, large.rows() / 2));

  mesh.positions(7, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(seen(mesh, {0, 0, 1}).columns(), 0);
  mesh.positions.setConstant(0.5);
  const DepthMap point = seen(mesh, {0, 0, 1});
  for (int row = 0; row < point.rows(); ++row) {
    for (int column = 0; column < point.columns(); ++column) EXPECT_FALSE(is_covered(point, column, row));
  }
}

/// For any numbers, a map is made quickly, within its size limit, and read within its bounds.
TEST(DepthMap, TakesNumbersOfAnySize) {
  constexpr double huge = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
  const std::vector<double> sizes{0, tiny, 1e-300, 1e-162, 1e-30, 1, 1e16, 1e39, 1e154, 1e300, huge, INFINITY, NAN};
  for (const double scale : sizes) {
    for (const double place : sizes) {
      for (const double texel : sizes) {
        Mesh mesh = shuffled(3, 1);
        mesh.positions = ((mesh.positions * scale).array() + place).matrix();
        const DepthMap map = seen(mesh, {0.2, 0.3, 1}, texel, 256);
        ASSERT_LE(map.columns(), 256 + DepthMap::block);
        ASSERT_LE(map.rows(), 256 + DepthMap::block);
        const auto texels = static_cast<std::size_t>(map.columns()) * static_cast<std::size_t>(map.rows());
        ASSERT_EQ(map.nearest().size(), texels);
        if (texels == 0) continue;
        ASSERT_TRUE(map.places().allFinite());
        for (const double column : sizes) interpolated(map, map.nearest(), column, -column);
      }
    }
  }
  DepthMap map;
  map.look(Vector3d::Constant(NAN), Vector3d::UnitZ());
  const Mesh mesh = shuffled(3, 1);
  map.draw(mesh.positions, mesh.triangles, 0.1, 256);
  EXPECT_EQ(map.columns(), 0);
}

}  // namespace
}  // namespace drape::test
