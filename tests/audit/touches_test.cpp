// Surfaces whose vertices and edges meet exactly: those that pass through each other are told from those that touch.

#include "audit/touches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "audit/motion_audit.hpp"
#include "tests/audit/motions.hpp"

namespace drape::audit {
namespace {

Mesh shifted(Mesh mesh, const Eigen::RowVector3d& by) {
  mesh.positions.rowwise() += by;
  return mesh;
}

/// Swaps axes: a grid in the xy plane becomes one in the yz plane, with vertices at the same multiples of a cell.
Mesh upright(Mesh mesh) {
  const Vertices flat = mesh.positions;
  mesh.positions << flat.col(2), flat.col(1), flat.col(0);
  return mesh;
}

std::size_t passages(const std::vector<Passage>& found) {
  return static_cast<std::size_t>(std::ranges::count(found, false, &Passage::touch));
}

std::size_t passages_of_vertices(const std::vector<Passage>& found) {
  return static_cast<std::size_t>(std::ranges::count_if(
      found, [](const Passage& p) { return !p.touch && p.kind == Passage::Kind::vertex_triangle; }));
}

Vertices with_heights(Vertices x, Eigen::Index rows, double height) {
  x.topRows(rows).col(2).setConstant(height);
  return x;
}

// Equal sheets, one exactly above the other, swap sides: vertices go through vertices, edges through edges.
TEST(Touches, ArePassagesOfAlignedSheetsThatSwapSides) {
  for (const int cells : {1, 2, 7}) {
    const Mesh grid = make_grid(cells, cells);
    const Mesh both = joined(grid, grid);
    const Topology topology = make_topology(both.triangles);
    const Vertices from = with_heights(both.positions, grid.positions.rows(), 0.3),
                   to = with_heights(both.positions, grid.positions.rows(), -0.25);
    const std::vector<Passage> found = find_passages({topology, from, to});
    std::map<int, int> of_vertex;
    for (const Passage& p : found) {
      if (!p.touch && p.kind == Passage::Kind::vertex_triangle) ++of_vertex[p.vertices[0]];
    }
    EXPECT_GE(static_cast<int>(of_vertex.size()), std::max(1, (cells - 1) * (cells - 1))) << cells;
    for (const auto& [vertex, times] : of_vertex) EXPECT_EQ(times, 1) << vertex;

    const Topology one = make_topology(grid.triangles);
    const Vertices high = with_heights(grid.positions, grid.positions.rows(), 0.3),
                   low = with_heights(grid.positions, grid.positions.rows(), -0.25);
    EXPECT_GT(passages(find_passages({one, high, low}, {one, grid.positions, grid.positions})), 0U) << cells;
    EXPECT_GT(passages(find_passages({one, grid.positions, grid.positions}, {one, high, low})), 0U) << cells;
  }
}

// A tip goes through a vertex or the middle of an edge of a sheet.
TEST(Touches, OfATipThatGoesThroughAVertexOrAnEdgeAreOnePassage) {
  const Mesh grid = make_grid(4, 4);
  const Topology cloth = make_topology(grid.triangles), spike = make_topology({{0, 1, 2}});
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.25, 0), Eigen::Vector2d(0.25, 0.25)}) {
    Vertices from(3, 3);
    from << at[0], at[1], 0.125, at[0] + 0.01, at[1] + 0.003, 1, at[0] - 0.02, at[1] + 0.03, 1;
    Vertices to = from;
    to.col(2).array() -= 0.25;
    EXPECT_EQ(passages_of_vertices(find_passages({cloth, grid.positions, grid.positions}, {spike, from, to})), 1U)
        << at.transpose();
    to(0, 2) = 0;
    EXPECT_EQ(passages(find_passages({cloth, grid.positions, grid.positions}, {spike, from, to})), 0U)
        << "ends in the sheet";
  }
}

TEST(Touches, OfAVertexThatGrazesARidgeOrABorderAreNoPassage) {
  Mesh roof;
  roof.positions.resize(6, 3);
  roof.positions << -1, -1, -1, 0, -1, 0, 1, -1, -1, -1, 1, -1, 0, 1, 0, 1, 1, -1;
  roof.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  const Topology topology = make_topology(roof.triangles), needle = make_topology({{0, 1, 2}});
  Vertices from(3, 3), way(3, 3);
  from << -0.5, 0.25, 0, -0.6, 0.25, 1, -0.5, 0.5, 1;
  way.rowwise() = Eigen::RowVector3d(1, 0, 0);
  for (const double fall : {0.0, 0.125}) {
    Vertices to = from + way;
    to.col(2).array() -= fall;
    Vertices begin = from;
    begin.col(2).array() += fall;
    const std::vector<Passage> found = find_passages({topology, roof.positions, roof.positions}, {needle, begin, to});
    EXPECT_FALSE(found.empty());
    EXPECT_EQ(describe_all(found).find("meets"), std::string::npos) << describe_all(found);
  }
  const Mesh grid = make_grid(2, 2);  // its border is at x = 1
  const Topology sheet = make_topology(grid.triangles);
  from << 0.75, 0.1, 0.25, 0.8, 0.1, 1, 0.75, 0.2, 1;
  Vertices to = from;
  to.rowwise() += Eigen::RowVector3d(0.5, 0, -0.5);
  const std::vector<Passage> found = find_passages({sheet, grid.positions, grid.positions}, {needle, from, to});
  EXPECT_FALSE(found.empty());
  EXPECT_EQ(passages(found), 0U) << describe_all(found);
}

TEST(Touches, OfSheetsThatSlideOrFoldAreNoPassages) {
  const Mesh grid = make_grid(4, 4);
  const Mesh both = joined(grid, shifted(grid, {0.125, 0.25, 0}));
  const Topology topology = make_topology(both.triangles);
  Vertices slid = both.positions, lifted = both.positions;
  slid.topRows(grid.positions.rows()).rowwise() += Eigen::RowVector3d(0.25, 0.0625, 0);
  lifted.topRows(grid.positions.rows()).col(2).setConstant(0.5);
  for (const auto& [from, to] : {std::pair(both.positions, slid), std::pair(lifted, slid), std::pair(slid, lifted)}) {
    const std::vector<Passage> found = find_passages({topology, from, to});
    EXPECT_FALSE(found.empty());
    EXPECT_EQ(passages(found), 0U);
  }
  const Topology one = make_topology(grid.triangles);  // folded flat about its middle, and opened again
  Vertices standing = grid.positions, folded = grid.positions;
  for (Eigen::Index v = 0; v < grid.positions.rows(); ++v) {
    const double x = grid.positions(v, 0);
    if (x <= 0) continue;
    standing.row(v) = Eigen::RowVector3d(0, grid.positions(v, 1), x);
    folded(v, 0) = -x;
  }
  EXPECT_EQ(passages(find_passages({one, standing, folded})), 0U);
  EXPECT_EQ(passages(find_passages({one, folded, standing})), 0U);
  EXPECT_TRUE(find_crossings({one, folded}).empty());
}

// A sheet comes to rest exactly in another, for some states, and leaves it on either side.
TEST(Touches, AreAPassageOnceTheSheetLeavesOnTheOtherSide) {
  const Mesh grid = make_grid(3, 3);
  const Mesh both = joined(grid, grid);
  const std::vector<Collider> none;
  for (const int resting : {1, 3}) {
    for (const double end : {-0.5, 0.5}) {
      MotionAudit audit({.rest = both.positions, .triangles = both.triangles, .held = {}}, {});
      std::vector<double> heights(static_cast<std::size_t>(resting), 0.0);
      heights.insert(heights.begin(), {1, 0.5});
      heights.insert(heights.end(), {end, 2 * end});
      for (std::size_t i = 0; i < heights.size(); ++i) {
        const Vertices x = with_heights(both.positions, grid.positions.rows(), heights[i]);
        audit.add({static_cast<std::int64_t>(i), 0.1 * static_cast<double>(i), x, none});
      }
      EXPECT_EQ(audit.findings(Check::ways).states, end < 0 ? 1 : 0) << resting;
      EXPECT_EQ(audit.findings(Check::crossings).states, 0);
    }
  }
}

// Sheets at right angles, with vertices, edges or cells in each other's plane.
TEST(Touches, OfSheetsAtRightAnglesAreCrossings) {
  const Mesh grid = make_grid(4, 4);
  for (const double x : {0.0, 0.125, 0.25, 0.5}) {
    for (const double y : {0.0, 0.125, 0.25, 0.5}) {
      for (const double z : {0.0, 0.125, 0.25, 0.5}) {
        const Mesh other = shifted(upright(grid), {x, y, z});
        const Topology one = make_topology(grid.triangles), two = make_topology(other.triangles);
        const Mesh both = joined(grid, other);
        const Topology all = make_topology(both.triangles);
        EXPECT_FALSE(find_crossings({all, both.positions}).empty()) << x << ' ' << y << ' ' << z;
        EXPECT_FALSE(find_crossings({one, grid.positions}, {two, other.positions}).empty());
      }
    }
  }
}

TEST(Touches, OfSheetsThatLieOrStandOnEachOtherAreNoCrossings) {
  const Mesh grid = make_grid(4, 4);
  for (const double y : {0.0, 0.125, 0.25, 0.5}) {
    for (const Mesh& other : {shifted(upright(grid), {0, y, 1}), shifted(upright(grid), {0.5, y, 1}),
                              shifted(grid, {0, y, 0}), shifted(grid, {0.125, y, 0}), shifted(grid, {2, y, 0})}) {
      const Mesh both = joined(grid, other);
      const Topology all = make_topology(both.triangles);
      EXPECT_EQ(describe_all(find_crossings({all, both.positions})), "");
      const Topology one = make_topology(grid.triangles), two = make_topology(other.triangles);
      EXPECT_EQ(describe_all(find_crossings({one, grid.positions}, {two, other.positions})), "");
    }
  }
}

}  // namespace
}  // namespace drape::audit
