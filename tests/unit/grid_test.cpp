#include "drape/sim/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace drape::grid_test {
namespace {

double area(const Mesh& mesh, const Triangle& t) {
  const Eigen::RowVector3d a = mesh.positions.row(t[0]), b = mesh.positions.row(t[1]), c = mesh.positions.row(t[2]);
  return ((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x())) / 2;
}

class PatternedGrid : public testing::TestWithParam<GridPattern> {};
INSTANTIATE_TEST_SUITE_P(, PatternedGrid,
                         testing::Values(GridPattern::diagonal, GridPattern::alternating, GridPattern::x,
                                         GridPattern::equilateral));

// Counterclockwise triangles with the rectangle's total area, and two triangles at every edge except on its border.
TEST_P(PatternedGrid, TilesItsRectangle) {
  for (const auto [columns, rows] : {std::array{1, 1}, std::array{5, 4}, std::array{4, 7}}) {
    const Mesh mesh =
        make_grid({.columns = columns, .rows = rows, .pattern = GetParam(), .size = Eigen::Vector2d(1.5, 0.8)});
    double sum = 0;
    std::map<Edge, int> sides;
    for (const Triangle& t : mesh.triangles) {
      EXPECT_GT(area(mesh, t), 0);
      sum += area(mesh, t);
      for (std::size_t k = 0; k < 3; ++k) ++sides[{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])}];
    }
    EXPECT_NEAR(sum, 1.5 * 0.8, 1e-14);
    for (const auto& [edge, count] : sides) {
      const Eigen::RowVector3d middle = (mesh.positions.row(edge[0]) + mesh.positions.row(edge[1])) / 2;
      const bool border = std::abs(middle.x()) > 0.75 - 1e-9 || std::abs(middle.y()) > 0.4 - 1e-9;
      EXPECT_EQ(count, border ? 1 : 2);
    }
    EXPECT_EQ(mesh.positions.rows() - static_cast<Eigen::Index>(sides.size() - mesh.triangles.size()), 1) << "Euler's";
    ASSERT_EQ(mesh.uvs.size(), 3 * mesh.triangles.size());
    for (std::size_t corner = 0; corner < mesh.uvs.size(); ++corner) {
      const int vertex = mesh.triangles[corner / 3][corner % 3];
      EXPECT_NEAR(mesh.uvs[corner][0], mesh.positions(vertex, 0) / 1.5 + 0.5, 1e-6);
      EXPECT_NEAR(mesh.uvs[corner][1], mesh.positions(vertex, 1) / 0.8 + 0.5, 1e-6);
    }
  }
}

TEST(GridPatterns, OfOneDiagonalIsTheHomeworks) {
  const Mesh homework = make_grid(7, 5), mesh = make_grid({.columns = 7, .rows = 5});
  EXPECT_EQ(mesh.positions, homework.positions);
  EXPECT_EQ(mesh.triangles, homework.triangles);
  EXPECT_EQ(mesh.uvs, homework.uvs);
}

TEST(GridPatterns, OfEquilateralTrianglesHasThemAllAlike) {
  const Mesh mesh = make_grid({.columns = 8, .rows = 6, .pattern = GridPattern::equilateral});
  int whole = 0;
  for (const Triangle& t : mesh.triangles) {
    const bool half = area(mesh, t) < 0.75 * std::sqrt(3.0) / 4 / 16;
    for (std::size_t k = 0; k < 3 && !half; ++k) {
      EXPECT_NEAR((mesh.positions.row(t[k]) - mesh.positions.row(t[(k + 1) % 3])).norm(), 0.25, 1e-14);
    }
    whole += half ? 0 : 1;
  }
  EXPECT_EQ(whole, 6 * (2 * 8 - 1));
}

TEST(GridPatterns, NeedsCellsAndAPositiveSize) {
  EXPECT_THROW(make_grid({.columns = 0}), std::invalid_argument);
  EXPECT_THROW(make_grid({.columns = 100'000, .rows = 100'000}), std::invalid_argument);
  EXPECT_THROW(make_grid({.size = Eigen::Vector2d(1, 0)}), std::invalid_argument);
}

}  // namespace
}  // namespace drape::grid_test
