// Edges beyond a limit, and energy that rises without work.

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "audit/motion_audit.hpp"

namespace drape::audit {
namespace {

TEST(StretchedEdges, AreFoundBeyondTheLimitAlone) {
  const Mesh grid = make_grid(4, 4);
  const std::vector<Edge> edges = unique_edges(grid.triangles);
  Vertices x = 1.0625 * grid.positions;
  EXPECT_TRUE(find_stretched(edges, grid.positions, x, 1.0625).empty());
  EXPECT_EQ(find_stretched(edges, grid.positions, x, 1.0624).size(), edges.size());
  x = grid.positions;
  x(0, 0) -= 0.1;  // a corner: one side grows from 0.5 to 0.6
  const std::vector<StretchedEdge> found = find_stretched(edges, grid.positions, x, 1.19);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].edge, (Edge{0, 1}));
  EXPECT_NEAR(found[0].stretch, 1.2, 1e-15);
  EXPECT_EQ(describe(found[0]), "cloth edge 0 1 is stretched to 1.2");
}

TEST(StretchedEdges, AreThoseWithoutALengthAndThoseThatAreNotFinite) {
  Vertices rest = Vertices::Zero(3, 3), x = rest;
  rest(2, 0) = 1;
  x(1, 0) = 0.1;
  x(2, 0) = NAN;
  const std::vector<StretchedEdge> found = find_stretched({{0, 1}, {0, 2}}, rest, x, 2);
  ASSERT_EQ(found.size(), 2U);
  for (const StretchedEdge& edge : found) EXPECT_TRUE(std::isinf(edge.stretch));
  EXPECT_THROW(find_stretched({}, rest, Vertices::Zero(2, 3), 2), std::invalid_argument);
}

TEST(LargestRise, IsOverTheLeastEnergySoFar) {
  const EnergyRise rise = largest_rise(std::vector<double>{5, 3, 4, 1, 2.5, 2, 3.25, 0});
  EXPECT_EQ(rise.rise, 2.25);
  EXPECT_EQ(rise.from, 3);
  EXPECT_EQ(rise.to, 6);
  EXPECT_EQ(largest_rise(std::vector<double>{5, 4, 4, 1}).rise, 0);
  EXPECT_EQ(largest_rise({}).rise, 0);
}

TEST(LargestRise, LeavesOutTheWorkThatIsDone) {
  const std::vector<double> energies{1, 3, 3, 4}, work{2, 0, 0.5};
  const EnergyRise rise = largest_rise(energies, work);
  EXPECT_EQ(rise.rise, 0.5);
  EXPECT_EQ(rise.to, 3);
  EXPECT_THROW(largest_rise(energies, std::vector<double>{1}), std::invalid_argument);
}

TEST(LargestRise, IsInfiniteWhereAnEnergyIsNotFinite) {
  const EnergyRise rise = largest_rise(std::vector<double>{1, NAN, 0});
  EXPECT_TRUE(std::isinf(rise.rise));
  EXPECT_EQ(rise.to, 1);
}

}  // namespace
}  // namespace drape::audit
