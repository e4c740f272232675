// Intersections at one moment, and vertices inside bodies.

#include "audit/crossings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/audit/motions.hpp"
#include "tests/support/intersections.hpp"

namespace drape::audit {
namespace {

using Eigen::Vector3d;

TEST(Crossings, OfRandomMeshesAreThoseOfAllPairs) {
  const Mesh grid = make_grid(8, 8);
  const Topology topology = make_topology(grid.triangles);
  test::Random random;
  std::size_t found = 0;
  for (int i = 0; i < test::tries(20); ++i) {
    const Vertices x = shaken_grid(grid, 0.3, random);
    std::vector<Crossing> expected;
    for (const Edge& edge : topology.edges) {
      for (const Triangle& t : topology.triangles) {
        const auto has = [&](int v) { return v == t[0] || v == t[1] || v == t[2]; };
        const auto at = [&](int v) -> Vector3d { return x.row(v).transpose(); };
        if (has(edge[0]) || has(edge[1])) continue;
        if (goes_through({at(edge[0]), at(edge[1])}, {at(t[0]), at(t[1]), at(t[2])})) {
          expected.push_back({Owner::cloth, edge, Owner::cloth, t});
        }
      }
    }
    sort(expected);
    ASSERT_EQ(find_crossings({topology, x}), expected);
    ASSERT_EQ(test::self_intersections(topology.triangles, x), static_cast<int>(expected.size()));
    found += expected.size();
  }
  EXPECT_GT(found, static_cast<std::size_t>(test::tries(1000)));
}

TEST(Crossings, AreNotInAClothThatIsPlacedAnywhere) {
  const Mesh grid = make_grid(20, 20);
  const Topology topology = make_topology(grid.triangles);
  for (int i = 0; i < 20; ++i) {
    const Vertices x = moved(grid.positions, 0.3 * i, {std::pow(10, i - 6), 0.3, -std::pow(7, i - 10)});
    EXPECT_EQ(describe_all(find_crossings({topology, i % 2 == 0 ? x : 1e-5 * x})), "") << i;
  }
}

// A pole through the middle of a symmetric cloth passes exactly through one of its vertices or edges, not through a
// triangle's interior.
TEST(Crossings, OfAPoleThroughAVertexOrAnEdgeOfTheClothAreFound) {
  const Mesh grid = make_grid(4, 4);
  const Topology cloth = make_topology(grid.triangles), pole = make_topology({{0, 1, 2}});
  for (const Vector3d& at : {Vector3d(0, 0, 0), Vector3d(0.25, 0, 0), Vector3d(0.25, 0.25, 0)}) {
    Vertices x(3, 3);
    x << at[0], at[1], -1, at[0], at[1], 1, at[0] + 0.01, at[1] + 0.003, 1;
    const std::vector<Crossing> found = find_crossings({cloth, grid.positions}, {pole, x});
    EXPECT_TRUE(std::ranges::any_of(found, [](const Crossing& c) { return c.edge == Edge{0, 1}; })) << at.transpose();
  }
}

TEST(Crossings, AreNamed) {
  const Crossing crossing{Owner::body, {1, 2}, Owner::cloth, {3, 4, 5}};
  EXPECT_EQ(describe(crossing), "body edge 1 2 goes through cloth triangle 3 4 5");
}

TEST(Crossings, DoNotCountTouching) {
  const std::array triangle{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)};
  EXPECT_FALSE(goes_through({Vector3d(0.2, 0.2, 0), Vector3d(0.2, 0.2, 1)}, triangle));
  EXPECT_TRUE(goes_through({Vector3d(0.2, 0.2, -1e-60), Vector3d(0.2, 0.2, 1)}, triangle));
  EXPECT_TRUE(goes_through({Vector3d(0.5, 0.5, -1), Vector3d(0.5, 0.5, 1)}, triangle)) << "through its border";
  EXPECT_FALSE(goes_through({Vector3d(0.5, 0.5 + 0x1p-53, -1), Vector3d(0.5, 0.5 + 0x1p-52, 1)}, triangle));
  EXPECT_FALSE(goes_through({Vector3d(-1, 0.2, 0), Vector3d(1, 0.2, 0)}, triangle)) << "in its plane";
}

/// Makes a box from −1/2 to 1/2 with outward triangles, scaled and moved.
Mesh box(const Eigen::RowVector3d& size, const Eigen::RowVector3d& center) {
  Mesh mesh;
  mesh.positions.resize(8, 3);
  for (int v = 0; v < 8; ++v) {
    const Eigen::RowVector3d corner((v & 1) != 0 ? 1 : 0, (v & 2) != 0 ? 1 : 0, (v & 4) != 0 ? 1 : 0);
    mesh.positions.row(v) = (corner.array() - 0.5) * size.array() + center.array();
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(InsideOfABox, IsFoundWithItsDepth) {
  const Mesh crate = box({1, 1, 0.5}, {0, 0, 0.25});
  const Topology topology = make_topology(crate.triangles);
  Vertices x(6, 3);
  x << 0, 0, 0.472, 0.3, 0.3, 0.25, 0, 0, 0.5, 0, 0, 0.6, 0.49, 0, 0.25, 2, 0, 0;
  const std::vector<Inside> found = find_inside(x, {topology, crate.positions});
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].vertex, 1);
  EXPECT_NEAR(found[0].depth, 0.2, 1e-15);
  EXPECT_EQ(describe(found[1]), "cloth vertex 0 is 28 mm deep inside");
  EXPECT_EQ(found[2].vertex, 4);
}

std::size_t count_inside(const Vertices& x, const Mesh& solid) {
  const Topology topology = make_topology(solid.triangles);
  return find_inside(x, {topology, solid.positions}).size();
}

// Vertices on the lattice of the boxes' own corners, edges and diagonals, which axis-parallel rays would hit exactly:
// multiples of 1/2 from −2 to 4 in x and from −1 to 1 in y and z.
TEST(InsideOfABox, IsExactOnItsOwnLattice) {
  Vertices x(13 * 5 * 5, 3);
  int v = 0;
  for (int i = -4; i <= 8; ++i) {
    for (int j = -2; j <= 2; ++j) {
      for (int k = -2; k <= 2; ++k) x.row(v++) << 0.5 * i, 0.5 * j, 0.5 * k;
    }
  }
  const Mesh crate = box({2, 2, 2}, {0, 0, 0});
  EXPECT_EQ(count_inside(x, crate), 27U);
  Mesh inside_out = crate;
  for (Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(count_inside(x, inside_out), 27U);
  EXPECT_EQ(count_inside(x, joined(crate, box({1, 2, 2}, {2.5, 0, 0}))), 36U) << "a gap between 1 and 2";
  EXPECT_EQ(count_inside(x, joined(crate, box({2, 2, 2}, {1, 0, 0}))), 27U)
      << "from −1 to 2, without those on the faces at 0 and 1 within the other part";
}

TEST(InsideOfABox, IsAsDeepAsItsNearestFaceIsFar) {
  const Mesh crate = box({2, 2, 2}, {0, 0, 0});
  const Topology topology = make_topology(crate.triangles);
  test::Random random;
  Vertices x(300, 3);
  for (int v = 0; v < x.rows(); ++v) x.row(v) = 1.2 * test::random_point(random).transpose();
  for (const double angle : {0.0, 0.4, 1.1, 2.5}) {
    const Eigen::RowVector3d shift = angle * Eigen::RowVector3d(1, -2, 3);
    const std::vector<Inside> found =
        find_inside(moved(x, angle, shift), {topology, moved(crate.positions, angle, shift)});
    EXPECT_EQ(static_cast<Eigen::Index>(found.size()), ((x.array().abs() < 1).rowwise().all()).count()) << angle;
    for (const Inside& inside : found) {
      EXPECT_NEAR(inside.depth, (1 - x.row(inside.vertex).array().abs()).minCoeff(), 1e-13);
    }
  }
}

TEST(InsideOfABox, NeedsAClosedMesh) {
  const Mesh grid = make_grid(2, 2);
  const Topology topology = make_topology(grid.triangles);
  EXPECT_FALSE(is_closed(grid.triangles));
  EXPECT_TRUE(is_closed(box({1, 1, 1}, {0, 0, 0}).triangles));
  EXPECT_THROW(find_inside(grid.positions, {topology, grid.positions}), std::invalid_argument);
}

TEST(InsideOfASphereAndAPlane, IsFoundWithItsDepth) {
  Vertices x(3, 3);
  x << 0, 0, 0.9, 0, 0.5, 0, 0, 0, -0.02;
  const std::vector<Inside> sphere = find_inside_sphere(x, {0, 0, 0}, 0.8);
  ASSERT_EQ(sphere.size(), 2U);
  EXPECT_EQ(sphere[0].vertex, 2);
  EXPECT_NEAR(sphere[0].depth, 0.78, 1e-15);
  EXPECT_NEAR(sphere[1].depth, 0.3, 1e-15);
  const std::vector<Inside> ground = find_behind_plane(x, {5, 5, 0.01}, {0, 0, 1});
  ASSERT_EQ(ground.size(), 2U);
  EXPECT_NEAR(ground[0].depth, 0.03, 1e-15);
}

}  // namespace
}  // namespace drape::audit
