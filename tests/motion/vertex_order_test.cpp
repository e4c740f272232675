#include "motion/vertex_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/support/random.hpp"

namespace drape {
namespace {

VertexOrder shuffled(int count) {
  VertexOrder order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  test::Random random(11);
  for (int i = count - 1; i > 0; --i)
    std::swap(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(random.below(i + 1))]);
  return order;
}

TEST(VertexOrder, IsFoundByPositionsThatAreNearlyTheSame) {
  const Mesh grid = make_grid(30, 20);
  const VertexOrder order = shuffled(static_cast<int>(grid.positions.rows()));
  Vertices x = in_order(grid.positions, order);
  test::Random random(5);
  for (auto row : x.rowwise()) row += 1e-5 * test::random_point(random).transpose();
  EXPECT_EQ(match_vertices(x, grid.positions, 1e-3), order);
  EXPECT_FALSE(match_vertices(x, grid.positions, 1e-7)) << "nothing is so near";
}

TEST(VertexOrder, IsNotGuessed) {
  const Mesh grid = make_grid(4, 4);
  Vertices twice = grid.positions;
  twice.row(3) = twice.row(4);
  EXPECT_FALSE(match_vertices(grid.positions, twice, 1e-3)) << "two vertices are at one place";
  EXPECT_FALSE(match_vertices(twice, grid.positions, 1e-3));
  EXPECT_FALSE(match_vertices(grid.positions, make_grid(4, 5).positions, 1e-3));
}

TEST(VertexOrder, KeepsACloth) {
  const Mesh grid = make_grid(5, 4);
  Cloth cloth = make_cloth(grid, grid, 1, 10, {0, 5});
  cloth.masses = Eigen::VectorXd::LinSpaced(cloth.vertex_count(), 1, 2);
  const VertexOrder order = shuffled(cloth.vertex_count());
  const Cloth other = in_order(cloth, order);
  for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(other.positions.row(other.triangles[t][c]), cloth.positions.row(cloth.triangles[t][c]));
    }
  }
  for (std::size_t s = 0; s < cloth.springs.size(); ++s) {
    const Spring& spring = other.springs[s];
    EXPECT_LT(spring.i, spring.j);
    EXPECT_NEAR((other.rest.row(spring.i) - other.rest.row(spring.j)).norm(), cloth.springs[s].rest_length, 1e-12);
  }
  ASSERT_EQ(other.pins.size(), 2U);
  EXPECT_TRUE(std::ranges::is_sorted(other.pins));
  for (const int pin : other.pins) EXPECT_TRUE(order[static_cast<std::size_t>(pin)] % 5 == 0);
  for (int i = 0; i < cloth.vertex_count(); ++i)
    EXPECT_EQ(other.masses[i], cloth.masses[order[static_cast<std::size_t>(i)]]);
}

}  // namespace
}  // namespace drape
