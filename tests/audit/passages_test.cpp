// Meetings in a step: inserted defects, motions without any, and random motions compared with all pairs.

#include "audit/passages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <stdexcept>

#include "audit/crossings.hpp"
#include "tests/audit/motions.hpp"
#include "tests/support/intersections.hpp"

namespace drape::audit {
namespace {

using Kind = Passage::Kind;
using Names = std::set<std::array<int, 5>>;  // kind and vertices

Names names(const std::vector<Passage>& found) {
  Names all;
  for (const Passage& p : found) {
    all.insert({static_cast<int>(p.kind), p.vertices[0], p.vertices[1], p.vertices[2], p.vertices[3]});
  }
  return all;
}

/// Tests all pairs without a broad phase.
Names all_pairs(const SurfaceMotion& motion) {
  const auto way = [&](int v) { return Way{motion.from.row(v).transpose(), motion.to.row(v).transpose()}; };
  Names all;
  for (int v = 0; v < motion.from.rows(); ++v) {
    for (const auto& [a, b, c] : motion.topology.triangles) {
      if (v == a || v == b || v == c) continue;
      if (vertex_meets_triangle(way(v), {way(a), way(b), way(c)})) all.insert({0, v, a, b, c});
    }
  }
  for (const Edge& e : motion.topology.edges) {
    for (const Edge& f : motion.topology.edges) {
      if (e >= f || e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1]) continue;
      if (edges_meet({way(e[0]), way(e[1])}, {way(f[0]), way(f[1])})) all.insert({1, e[0], e[1], f[0], f[1]});
    }
  }
  return all;
}

TEST(Passages, OfRandomMotionsAreThoseOfAllPairs) {
  const Mesh grid = make_grid(8, 8);
  const Topology topology = make_topology(grid.triangles);
  test::Random random;
  std::size_t found = 0;
  for (int i = 0; i < test::tries(10); ++i) {
    const Vertices from = shaken_grid(grid, 0.3, random), to = shaken_grid(grid, 0.3, random);
    const SurfaceMotion motion{topology, from, to};
    const std::vector<Passage> passages = find_passages(motion);
    ASSERT_EQ(names(passages), all_pairs(motion));
    ASSERT_EQ(names(passages).size(), passages.size()) << "each pair once";
    ASSERT_EQ(test::self_crossings(topology.triangles, from, to), static_cast<int>(passages.size()));
    found += passages.size();
  }
  EXPECT_GT(found, static_cast<std::size_t>(test::tries(1000)));
}

// The broad phase subtracts the common motion of all vertices. Far from the origin, rounding in its frame is as large
// as the motion.
TEST(Passages, OfMotionsWithALargeCommonWayAreThoseOfAllPairs) {
  const Mesh grid = make_grid(6, 6);
  const Topology topology = make_topology(grid.triangles);
  test::Random random(11);
  std::size_t found = 0;
  for (const double shift : {1e-3, 3.0, 1e6, 1e15, 3e16}) {
    const Vertices from = shaken_grid(grid, 0.3, random);
    Vertices to = shaken_grid(grid, 0.3, random);
    to.rowwise() += shift * Eigen::RowVector3d(0.3, -0.7, 0.1);
    const Names expected = all_pairs({topology, from, to});
    ASSERT_EQ(names(find_passages({topology, from, to})), expected) << shift;
    found += expected.size();
  }
  EXPECT_GT(found, 100U);
}

// Positions on an integer lattice: most meeting pairs touch exactly, and many boxes share a side.
TEST(Passages, OnALatticeAreThoseOfAllPairs) {
  const Mesh grid = make_grid(4, 4);
  const Topology topology = make_topology(grid.triangles);
  test::Random random(5);
  int touched = 0;
  for (int i = 0; i < test::tries(100); ++i) {
    const auto lattice = [&] { return (6 * shaken_grid(grid, 0.5, random)).array().round().matrix().eval(); };
    const Vertices from = lattice(), to = i % 3 == 0 ? from : lattice();
    const std::vector<Passage> passages = find_passages({topology, from, to});
    ASSERT_EQ(names(passages), all_pairs({topology, from, to})) << i;
    touched += static_cast<int>(std::ranges::count(passages, true, &Passage::touch));
  }
  EXPECT_GT(touched, test::tries(100));
}

TEST(Passages, OfAFlatClothThatIsShakenALittleAreThoseOfAllPairs) {
  const Mesh grid = make_grid(8, 8);
  const Topology topology = make_topology(grid.triangles);
  test::Random random(7);
  std::size_t found = 0;
  for (int i = 0; i < test::tries(20); ++i) {
    Vertices from = shaken_grid(grid, 0.12, random), to = shaken_grid(grid, 0.12, random);
    if (i % 2 == 0) from.col(2).setZero(), to.col(2).setZero();  // a planar motion: all volumes are zero
    const SurfaceMotion motion{topology, from, to};
    const Names expected = all_pairs(motion);
    ASSERT_EQ(names(find_passages(motion)), expected);
    found += expected.size();
  }
  EXPECT_GT(found, static_cast<std::size_t>(test::tries(20)));
}

// A step without crossings at its start explains each crossing at its end by a passage.
TEST(Passages, ExplainEveryCrossingAtTheEnd) {
  const Mesh grid = make_grid(8, 8);
  const Topology topology = make_topology(grid.triangles);
  test::Random random(3);
  int crossed = 0;
  for (int i = 0; i < 20; ++i) {
    const Vertices to = shaken_grid(grid, 0.17, random);
    if (find_crossings({topology, to}).empty()) continue;
    ++crossed;
    EXPECT_FALSE(find_passages({topology, grid.positions, to}).empty());
  }
  EXPECT_GT(crossed, 0);
}

// Linear paths between a mesh and its rotated image are affine images of the mesh, all regular below half a turn.
TEST(Passages, AreNotInRigidMotions) {
  const Mesh grid = make_grid(8, 8);
  const Topology topology = make_topology(grid.triangles);
  test::Random random;
  const Vertices rough = shaken_grid(grid, 0.04, random);
  for (const Vertices& x : {grid.positions, rough}) {
    ASSERT_TRUE(find_crossings({topology, x}).empty());
    for (const double angle : {0.0, 1e-9, 0.1, 1.0, 0.9 * std::numbers::pi}) {
      for (const double shift : {0.0, 1e-7, 0.03, 5.0}) {
        const Vertices to = moved(x, angle, {shift, -shift / 3, shift / 7});
        EXPECT_EQ(describe_all(find_passages({topology, x, to})), "") << angle << ' ' << shift;
      }
    }
  }
}

// A half turn flattens the cloth on its way.
TEST(Passages, AreInAHalfTurn) {
  const Mesh grid = make_grid(2, 2);
  const Topology topology = make_topology(grid.triangles);
  const Vertices to = -grid.positions;
  EXPECT_FALSE(find_passages({topology, grid.positions, to}).empty());
}

/// Two sheets above each other, in one cloth.
struct TwoSheets {
  Mesh mesh = make_grid(8, 8);
  int half = static_cast<int>(mesh.positions.rows());
  Topology topology;

  explicit TwoSheets(double gap) {
    const Mesh lower = mesh;
    mesh.positions.conservativeResize(2 * lower.positions.rows(), Eigen::NoChange);
    mesh.positions.bottomRows(half) = lower.positions;
    mesh.positions.bottomRows(half).rowwise() += Eigen::RowVector3d(0.0101, 0.0203, -gap);
    for (const auto& [a, b, c] : lower.triangles) mesh.triangles.push_back({a + half, b + half, c + half});
    topology = make_topology(mesh.triangles);
  }
};

TEST(Passages, ShowAVertexThatGoesThroughForOneStep) {
  const TwoSheets sheets(0.01);
  const int vertex = 40;
  const Vertices& still = sheets.mesh.positions;
  Vertices through = still;
  through(vertex, 2) -= 0.015;
  EXPECT_EQ(describe_all(find_passages({sheets.topology, still, still})), "");
  EXPECT_TRUE(find_crossings({sheets.topology, still}).empty());
  for (const auto& [from, to] : {std::pair(still, through), std::pair(through, still)}) {
    const std::vector<Passage> found = find_passages({sheets.topology, from, to});
    EXPECT_EQ(std::ranges::count_if(
                  found, [&](const Passage& p) { return p.kind == Kind::vertex_triangle && p.vertices[0] == vertex; }),
              1);
  }
  const std::vector<Crossing> crossings = find_crossings({sheets.topology, through});
  ASSERT_FALSE(crossings.empty());
  EXPECT_TRUE(
      std::ranges::any_of(crossings, [&](const Crossing& c) { return c.edge[0] == vertex || c.edge[1] == vertex; }));
}

// The sheets swap sides without a crossing at either state: only the paths between show it.
TEST(Passages, ShowSheetsThatSwapSides) {
  const TwoSheets sheets(0.01);
  Vertices swapped = sheets.mesh.positions;
  swapped.topRows(sheets.half).col(2).array() -= 0.02;
  EXPECT_TRUE(find_crossings({sheets.topology, swapped}).empty());
  const std::vector<Passage> found = find_passages({sheets.topology, sheets.mesh.positions, swapped});
  EXPECT_GE(std::ranges::count(found, Kind::vertex_triangle, &Passage::kind), 49);
  EXPECT_GE(std::ranges::count(found, Kind::edge_edge, &Passage::kind), 100);
  for (const Passage& p : found) EXPECT_NEAR(p.time, 0.5, 1e-9);
}

TEST(Passages, ShowAVertexThatGoesInAndOutWithinTheStep) {
  const Topology topology = make_topology({{0, 1, 2}});
  Vertices from(4, 3), to(4, 3);
  from << -1, -1, 0, 1, -1, 0, 0, 2, 0, 0, 1, 3.0 / 16;
  to << -1, -1, 0, 1, -1, 0, 0, 2, 3, 0, 0, 1 + 3.0 / 16;
  EXPECT_TRUE(find_crossings({topology, from}).empty());
  EXPECT_TRUE(find_crossings({topology, to}).empty());
  const std::vector<Passage> found = find_passages({topology, from, to});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(describe(found[0]), "cloth vertex 3 meets cloth triangle 0 1 2 at 0.25 of the step");
}

// Two triangles with a common edge: the folded corner is no vertex of the other triangle.
TEST(Passages, ShowTrianglesThatFoldThroughTheirNeighbours) {
  const Topology topology = make_topology({{0, 1, 2}, {1, 0, 3}});
  Vertices from(4, 3), to(4, 3);
  from << 0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, 0.5, 0.1;
  to << 0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, 0.5, -0.1;
  const std::vector<Passage> found = find_passages({topology, from, to});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, Kind::vertex_triangle);
  EXPECT_EQ(found[0].vertices, (std::array{3, 0, 1, 2}));
  from(3, 1) = to(3, 1) = 2;  // beyond the neighbour's corner, which passes through this triangle
  EXPECT_EQ(names(find_passages({topology, from, to})), (Names{{0, 2, 1, 0, 3}}));
  from(3, 0) = to(3, 0) = 2;  // neither corner is above the other triangle: edges 1–2 and 0–3 meet
  from(3, 1) = to(3, 1) = 1;
  EXPECT_EQ(names(find_passages({topology, from, to})), (Names{{1, 0, 3, 1, 2}}));
}

TEST(Passages, OfClothAndAMovingBodyAreFoundBothWays) {
  const Mesh grid = make_grid(4, 4);
  const Topology cloth = make_topology(grid.triangles), spike = make_topology({{0, 1, 2}});
  Vertices from(3, 3);
  from << 0.05, 0.1, -0.1, 0.1, 0.1, -1, 0.1, 0.3, -1;
  Vertices to = from;
  to.col(2).array() += 0.2;
  const std::vector<Passage> found = find_passages({cloth, grid.positions, grid.positions}, {spike, from, to});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(describe(found[0]).starts_with("body vertex 0 meets cloth triangle ")) << describe(found[0]);
  EXPECT_EQ(find_crossings({cloth, grid.positions}, {spike, to}).size(), 2U);
  EXPECT_TRUE(find_crossings({cloth, grid.positions}, {spike, from}).empty());
  Vertices lifted = grid.positions;
  lifted.col(2).array() += 0.2;
  EXPECT_TRUE(find_passages({cloth, grid.positions, lifted}, {spike, from, to}).empty()) << "both move alike";
  const std::vector<Passage> swapped = find_passages({spike, from, to}, {cloth, grid.positions, grid.positions});
  ASSERT_EQ(swapped.size(), 1U);
  EXPECT_EQ(swapped[0].first_owner, Owner::cloth);
}

TEST(Passages, OfWhatIsNoMotionAreErrors) {
  const Topology topology = make_topology({{0, 1, 2}});
  const Vertices two = Vertices::Zero(2, 3), three = Vertices::Zero(3, 3), four = Vertices::Zero(4, 3);
  Vertices nan = three;
  nan(1, 1) = NAN;
  EXPECT_THROW(find_passages({topology, two, two}), std::invalid_argument);
  EXPECT_THROW(find_passages({topology, three, four}), std::invalid_argument);
  EXPECT_THROW(find_passages({topology, three, nan}), std::invalid_argument);
  EXPECT_THROW(find_crossings({topology, nan}), std::invalid_argument);
  EXPECT_THROW(make_topology({{0, 1, 1}}), std::invalid_argument);
}

}  // namespace
}  // namespace drape::audit
