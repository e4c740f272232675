#include <gtest/gtest.h>

#include <stdexcept>

#include "drape/sim/cloth.hpp"
#include "sim/linear/sparse_cholesky.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

TEST(MakeCloth, MakesTheHomeworksCloth) {
  const Cloth cloth = cloth_of(make_grid(20, 20), 1, 180, {20, 0});
  EXPECT_EQ(cloth.vertex_count(), 441);
  EXPECT_EQ(cloth.triangles.size(), 800U);
  EXPECT_EQ(cloth.springs.size(), 1240U);
  EXPECT_EQ(cloth.pins, (std::vector{0, 20}));
  EXPECT_NEAR(cloth.masses.sum(), 1, 1e-14);
  EXPECT_EQ(cloth.masses.minCoeff(), cloth.masses.maxCoeff());
  EXPECT_EQ(cloth.velocities, Vertices::Zero(441, 3));
}

TEST(MakeCloth, GivesEverySpringTheLengthOfItsRestShapesEdge) {
  const Mesh rest = irregular_mesh(7);
  Mesh start = rest;
  start.positions = 2 * start.positions;
  const Cloth cloth = make_cloth(start, rest, 3, 25, {});
  EXPECT_EQ(cloth.springs.size(), unique_edges(rest.triangles).size());
  for (const Spring& spring : cloth.springs) {
    EXPECT_LT(spring.i, spring.j);
    EXPECT_EQ(spring.stiffness, 25);
    EXPECT_DOUBLE_EQ(spring.rest_length, (rest.positions.row(spring.i) - rest.positions.row(spring.j)).norm());
  }
  EXPECT_TRUE(same_bits(cloth.positions, start.positions));
  EXPECT_NEAR(cloth.masses.sum(), 3, 1e-13);
}

TEST(MakeCloth, GivesAnEdgeOfThreeTrianglesOneSpring) {
  const Mesh mesh = three_sheets(1);
  ASSERT_EQ(mesh.triangles.size(), 6U);
  int shared = 0;
  for (const Spring& spring : cloth_of(mesh, 1, 1, {}).springs) shared += spring.i == 0 && spring.j == 1 ? 1 : 0;
  EXPECT_EQ(shared, 1);
}

TEST(MakeCloth, SortsItsPinsAndKeepsEachOnce) {
  EXPECT_EQ(cloth_of(make_grid(2, 2), 1, 1, {8, 0, 8, 3, 0}).pins, (std::vector{0, 3, 8}));
}

TEST(MakeCloth, RefusesWhatDoesNotFit) {
  const Mesh grid = make_grid(2, 2);
  EXPECT_THROW(cloth_of(grid, 1, 1, {9}), std::invalid_argument);
  EXPECT_THROW(cloth_of(grid, 1, 1, {-1}), std::invalid_argument);
  EXPECT_THROW(make_cloth(grid, make_grid(2, 3), 1, 1, {}), std::invalid_argument);
  Mesh other = grid;
  std::swap(other.triangles[0], other.triangles[1]);
  EXPECT_THROW(make_cloth(grid, other, 1, 1, {}), std::invalid_argument);
  for (const int vertex : {-1, 9}) {
    other = grid;
    other.triangles[3][1] = vertex;
    EXPECT_THROW(cloth_of(other, 1, 1, {}), std::invalid_argument);
  }
}

TEST(FreeVertices, NumbersWhatIsNotPinnedInTheOrderOfTheCloth) {
  const FreeVertices free(cloth_of(make_grid(2, 2), 1, 1, {0, 4, 8}));
  ASSERT_EQ(free.count(), 6);
  int number = 0;
  for (const int vertex : {1, 2, 3, 5, 6, 7}) {
    EXPECT_EQ(free.number(vertex), number);
    EXPECT_EQ(free.vertex(number), vertex);
    ++number;
  }
  for (const int pin : {0, 4, 8}) EXPECT_EQ(free.number(pin), -1);
}

TEST(SpringPattern, HasTheDiagonalAndEverySpringBetweenFreeVerticesOnce) {
  Cloth cloth = cloth_of(make_grid(1, 1), 1, 1, {0});  // 0–1, 0–2, 1–2, 1–3, 2–3
  cloth.springs.push_back(cloth.springs.back());
  const LowerPattern pattern = spring_pattern({.springs = cloth.springs}, FreeVertices(cloth));
  EXPECT_EQ(pattern.starts, (std::vector{0, 3, 5, 6}));
  EXPECT_EQ(pattern.rows, (std::vector{0, 1, 2, 1, 2, 2}));
}

}  // namespace
}  // namespace drape::test
