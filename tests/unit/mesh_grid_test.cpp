#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "drape/sim/mesh.hpp"
#include "scene/mesh_value.hpp"

namespace drape {
namespace {

double signed_area(const Mesh& mesh, const Triangle& t) {
  const Eigen::RowVector3d a = mesh.positions.row(t[0]), b = mesh.positions.row(t[1]), c = mesh.positions.row(t[2]);
  return ((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x())) / 2;
}

class Grid : public ::testing::TestWithParam<std::array<int, 2>> {
 protected:
  const int columns = GetParam()[0], rows = GetParam()[1];
  const Mesh mesh = make_grid(columns, rows);
};

TEST_P(Grid, HasAsManyVerticesTrianglesAndEdgesAsItsCellsCallFor) {
  EXPECT_EQ(mesh.positions.rows(), (columns + 1) * (rows + 1));
  EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(2 * columns * rows));
  EXPECT_EQ(unique_edges(mesh.triangles).size(),
            static_cast<std::size_t>(columns * (rows + 1) + rows * (columns + 1) + columns * rows));
}

TEST_P(Grid, TilesTheSquareWithEqualCounterclockwiseTriangles) {
  const double expected = 4.0 / static_cast<double>(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) EXPECT_NEAR(signed_area(mesh, triangle), expected, 1e-14);
}

TEST_P(Grid, SpansTheSquareAtHeightZeroInRowMajorOrder) {
  for (int j = 0, vertex = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i, ++vertex) {
      EXPECT_NEAR(mesh.positions(vertex, 0), -1 + i * (2.0 / columns), 1e-15);
      EXPECT_NEAR(mesh.positions(vertex, 1), -1 + j * (2.0 / rows), 1e-15);
      EXPECT_EQ(mesh.positions(vertex, 2), 0);
    }
  }
  EXPECT_EQ(mesh.positions.row(mesh.positions.rows() - 1), Eigen::RowVector3d(1, 1, 0));
}

TEST_P(Grid, MapsTheSquareOntoTheUnitSquareOfTheTexture) {
  ASSERT_EQ(mesh.uvs.size(), 3 * mesh.triangles.size());
  for (std::size_t corner = 0; corner < mesh.uvs.size(); ++corner) {
    const auto position = mesh.positions.row(mesh.triangles[corner / 3][corner % 3]);
    EXPECT_NEAR(mesh.uvs[corner][0], (position[0] + 1) / 2, 1e-7);
    EXPECT_NEAR(mesh.uvs[corner][1], (position[1] + 1) / 2, 1e-7);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Grid,
                         ::testing::Values(std::array{1, 1}, std::array{2, 2}, std::array{3, 5}, std::array{20, 20},
                                           std::array{1, 40}),
                         [](const auto& size) {
                           return std::to_string(size.param[0]) + "x" + std::to_string(size.param[1]);
                         });

TEST(GridOfCells, ListsTheLowerLeftTrianglesOfAllCellsBeforeTheUpperRight) {
  const Mesh mesh = make_grid(2, 1);
  const std::vector<Triangle> expected = {{1, 3, 0}, {2, 4, 1}, {1, 4, 3}, {2, 5, 4}};
  EXPECT_EQ(mesh.triangles, expected);
}

TEST(GridOfCells, RefusesSizesWithoutACellOrBeyondCounting) {
  EXPECT_THROW(make_grid(0, 1), std::invalid_argument);
  EXPECT_THROW(make_grid(1, -1), std::invalid_argument);
  EXPECT_THROW(make_grid(2'000'000'000, 2'000'000'000), std::invalid_argument);
}

TEST(UniqueEdges, CountsAnEdgeOfThreeTrianglesOnce) {
  const std::vector<Edge> expected = {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 2}, {1, 3}, {1, 4}};
  EXPECT_EQ(unique_edges({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), expected);
}

TEST(UniqueEdges, GivesNoEdgeFromAVertexToItself) {
  const std::vector<Edge> expected = {{3, 5}};
  EXPECT_EQ(unique_edges({{5, 5, 3}}), expected);
  EXPECT_TRUE(unique_edges({{2, 2, 2}}).empty());
  EXPECT_TRUE(unique_edges({}).empty());
}

/// Returns the folder of the homework's own meshes, which are not part of the project; see DRAPE_REFERENCE_MESHES.
std::filesystem::path reference_meshes() {
  const char* folder = std::getenv("DRAPE_REFERENCE_MESHES");
  return folder != nullptr ? folder : DRAPE_SOURCE_DIR "/../shared/reference/meshes";
}

class HomeworkGrid : public ::testing::TestWithParam<int> {};

TEST_P(HomeworkGrid, IsTheGridWeMakeVertexByVertexFaceByFaceAndSpringBySpring) {
  const int n = GetParam();
  const auto file = reference_meshes() / ("grid" + std::to_string(n) + "x" + std::to_string(n) + ".usda");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file << ": set DRAPE_REFERENCE_MESHES to its folder";
  const Mesh theirs = read_mesh(file), ours = make_grid(n, n);
  ASSERT_EQ(theirs.positions.rows(), ours.positions.rows());
  EXPECT_LE((theirs.positions - ours.positions).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_EQ(theirs.triangles, ours.triangles);
  EXPECT_EQ(unique_edges(theirs.triangles), unique_edges(ours.triangles));
  ASSERT_EQ(theirs.uvs.size(), ours.uvs.size());
  for (std::size_t i = 0; i < ours.uvs.size(); ++i) {
    EXPECT_NEAR(theirs.uvs[i][0], ours.uvs[i][0], 1e-6);
    EXPECT_NEAR(theirs.uvs[i][1], ours.uvs[i][1], 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, HomeworkGrid, ::testing::Values(1, 2, 10, 20, 40),
                         [](const auto& size) { return std::to_string(size.param); });

}  // namespace
}  // namespace drape
