// Detection of a mesh that passes through itself: a flat one never does, and every real intersection is found.

#include "sim/collision/distance.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/support/random.hpp"

namespace drape::test {
namespace {

using Eigen::Vector3d;

Eigen::Matrix3d turned(double x, double y, double z) {
  const double degree = std::numbers::pi / 180;
  return (Eigen::AngleAxisd(z * degree, Vector3d::UnitZ()) * Eigen::AngleAxisd(y * degree, Vector3d::UnitY()) *
          Eigen::AngleAxisd(x * degree, Vector3d::UnitX()))
      .toRotationMatrix();
}

/// Rotates a mesh randomly and gives it a random size and position.
Mesh placed(Mesh mesh, Random& random) {
  const double size = std::pow(10, random.between(-6, 3));
  const Eigen::Matrix3d turn = turned(random.between(-180, 180), random.between(-180, 180), random.between(-180, 180));
  mesh.positions *= size * turn.transpose();
  for (int axis = 0; axis < 3; ++axis) mesh.positions.col(axis).array() += size * random.between(-100, 100);
  return mesh;
}

/// Joins a second mesh with the first.
Mesh joined(Mesh mesh, const Mesh& other) {
  const auto count = static_cast<int>(mesh.positions.rows());
  mesh.positions.conservativeResize(count + other.positions.rows(), Eigen::NoChange);
  mesh.positions.bottomRows(other.positions.rows()) = other.positions;
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + count, b + count, c + count});
  return mesh;
}

std::vector<Intersection> intersections(const Mesh& mesh) {
  std::vector<Point> points;
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) points.emplace_back(mesh.positions.row(i).transpose());
  return find_intersections(unique_edges(mesh.triangles), mesh.triangles, points);
}

bool goes_through_itself(const Mesh& mesh) { return !intersections(mesh).empty(); }

/// Makes a flat sheet, and a spike whose tip is `depth` behind it, at (x, y).
Mesh pierced_sheet(double x, double y, double depth) {
  Mesh spike;
  spike.positions.resize(3, 3);
  spike.positions << x, y, -depth, x, y + 0.05, 0.5, x + 0.01, y - 0.05, 0.5;
  spike.triangles = {{0, 1, 2}};
  return joined(make_grid(20, 20), spike);
}

std::size_t count_at_vertices(const Mesh& mesh) {
  std::vector<Point> points;
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) points.emplace_back(mesh.positions.row(i).transpose());
  return find_intersections_at_vertices(unique_edges(mesh.triangles), mesh.triangles, points).size();
}

// Two grids at right angles whose vertices lie in each other's plane, and grids that stand or lie on one another.
TEST(Intersection, AtVerticesIsWhereSheetsCrossAndNotWhereTheyTouch) {
  const Mesh grid = make_grid(4, 4);
  Random random;
  for (int i = 0; i < tries(100); ++i) {
    const bool still = i == 0;
    const auto upright = [&](const Eigen::RowVector3d& shift) {
      Mesh other = grid;
      other.positions = grid.positions * turned(0, 90, 0).transpose();
      other.positions.rowwise() += shift;
      const Mesh both = joined(grid, other);
      return count_at_vertices(still ? both : placed(both, random));
    };
    EXPECT_GT(upright({0, 0, 0}), 0U) << i;
    EXPECT_GT(upright({0.5, 0.5, 0.5}), 0U) << i;
    EXPECT_EQ(upright({0, 0, 1}), 0U) << i << ", stands on it";
    EXPECT_EQ(upright({1, 0, 0}), 0U) << i << ", at its border";
    EXPECT_EQ(count_at_vertices(still ? joined(grid, grid) : placed(joined(grid, grid), random)), 0U) << i;
  }
}

TEST(Intersection, IsNotWhereAFlatClothIsTurned) {
  for (const double x : {0, 10, 30, 45, 60, 77, 90}) {
    for (const double y : {0, 20, 40}) {
      for (const double z : {0, 15}) {
        Mesh mesh = make_grid(20, 20);
        mesh.positions *= turned(x, y, z).transpose();
        EXPECT_FALSE(goes_through_itself(mesh)) << x << ", " << y << ", " << z;
      }
    }
  }
}

TEST(Intersection, IsNotWhereAFlatClothIsPlacedAnywhere) {
  Random random;
  for (int i = 0; i < tries(300); ++i) {
    const Mesh grid = make_grid(1 + i % 20, 1 + i % 13);
    EXPECT_FALSE(goes_through_itself(placed(grid, random))) << i;
    EXPECT_FALSE(goes_through_itself(placed(joined(grid, grid), random))) << i << ", folded flat upon itself";
  }
}

// A cell is 0.1 wide, so the tip is behind the sheet by a millionth of that.
TEST(Intersection, IsFoundHoweverLittleGoesThrough) {
  Random random;
  for (int i = 0; i < tries(300); ++i) {
    const double x = random.between(-0.9, 0.9), y = random.between(-0.9, 0.9);
    EXPECT_TRUE(goes_through_itself(placed(pierced_sheet(x, y, 1e-7), random))) << i;
    EXPECT_FALSE(goes_through_itself(placed(pierced_sheet(x, y, -1e-7), random))) << i;
  }
}

TEST(Intersection, IsFoundAtASideAndAtACorner) {
  Random random;
  for (const Vector3d& tip : {Vector3d(0.05, 0.05, 0), Vector3d(0.1, 0.05, 0), Vector3d(0.1, 0.1, 0)}) {
    Mesh needle;
    needle.positions.resize(3, 3);
    needle.positions << tip.x(), tip.y(), -1, tip.x(), tip.y(), 1, 5, 5, 1;
    needle.triangles = {{0, 1, 2}};
    const Mesh mesh = joined(make_grid(20, 20), needle);
    EXPECT_TRUE(goes_through_itself(mesh)) << tip.transpose();
    for (int i = 0; i < tries(100); ++i) EXPECT_TRUE(goes_through_itself(placed(mesh, random))) << tip.transpose();
  }
}

// A strip that stands in a sheet, across one row of cells with two triangles each.
TEST(Intersection, IsEveryEdgeThroughEveryTriangleOnce) {
  Mesh strip = make_grid(1, 1);
  strip.positions << -0.33, 0.04, -0.5, 0.37, 0.04, -0.5, -0.33, 0.04, 0.5, 0.37, 0.04, 0.5;
  const Mesh mesh = joined(make_grid(20, 20), strip);
  const std::vector<Intersection> found = intersections(mesh);
  int of_strip = 0;
  for (const Intersection& one : found) {
    if (one.edge[0] >= 441) ++of_strip;
  }
  EXPECT_EQ(of_strip, 3);  // both sides and the diagonal
  // Edges of the sheet: across the row at x = -0.3, -0.2 … 0.3, and the diagonals that begin at −0.3 … 0.2, and one at
  // each end.
  EXPECT_EQ(static_cast<int>(found.size()) - of_strip, 7 + 7);
  for (std::size_t k = 1; k < found.size(); ++k) {
    EXPECT_LT(std::pair(found[k - 1].edge, found[k - 1].triangle), std::pair(found[k].edge, found[k].triangle));
  }
}

TEST(Intersection, IsFoundInMeshesOfAnySize) {
  for (const double size : {1e-290, 1e-150, 1.0, 1e100, 1e290}) {
    Mesh mesh = pierced_sheet(0.12, 0.34, 0.01);
    mesh.positions *= size;
    EXPECT_TRUE(goes_through_itself(mesh)) << size;
    mesh = make_grid(5, 5);
    mesh.positions *= size * turned(30, 40, 0).transpose();
    EXPECT_FALSE(goes_through_itself(mesh)) << size;
  }
}

}  // namespace
}  // namespace drape::test
