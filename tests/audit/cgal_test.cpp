// Intersections compared with an independent program: the exact predicates of CGAL (Brönnimann et al., Discrete Applied
// Mathematics 109, 2001).

#include <gtest/gtest.h>

#ifdef DRAPE_HAS_CGAL
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <set>
#include <utility>

#include "tests/audit/motions.hpp"
#endif

namespace drape::audit {
namespace {

#ifdef DRAPE_HAS_CGAL

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(const Vector3d& x) { return {x[0], x[1], x[2]}; }

/// Returns true if an edge goes through a triangle by CGAL's signs.
bool goes_through_by_cgal(const std::array<Vector3d, 2>& edge, const std::array<Vector3d, 3>& triangle) {
  const Kernel::Point_3 a = point(edge[0]), b = point(edge[1]), p = point(triangle[0]), q = point(triangle[1]),
                        r = point(triangle[2]);
  if (CGAL::orientation(p, q, r, a) * CGAL::orientation(p, q, r, b) != CGAL::NEGATIVE) return false;
  return CGAL::do_intersect(Kernel::Segment_3(a, b), Kernel::Triangle_3(p, q, r));
}

/// Counts the intersections among random edges and triangles, which both programs must agree about.
/// @param coordinate returns one coordinate of a point
template <class Coordinate>
int agreed(int tries, Coordinate&& coordinate) {
  int found = 0;
  const auto any = [&] { return Vector3d(coordinate(), coordinate(), coordinate()); };
  for (int i = 0; i < tries; ++i) {
    const std::array edge{any(), any()};
    const std::array triangle{any(), any(), any()};
    const bool expected = goes_through_by_cgal(edge, triangle);
    EXPECT_EQ(goes_through(edge, triangle), expected)
        << edge[0].transpose() << ", " << edge[1].transpose() << " and " << triangle[0].transpose() << ", "
        << triangle[1].transpose() << ", " << triangle[2].transpose();
    found += expected ? 1 : 0;
  }
  return found;
}

TEST(Cgal, FindsTheSameEdgesThroughTriangles) {
  test::Random random(5);
  EXPECT_GT(agreed(test::tries(20000), [&] { return random.between(-1, 1); }), test::tries(500));
}

/// Most of these touch: an end lies in the plane, or the edge meets the border or a corner.
TEST(Cgal, FindsTheSameOnALattice) {
  test::Random random(6);
  EXPECT_GT(agreed(test::tries(20000), [&] { return random.below(3); }), test::tries(500));
  EXPECT_GT(agreed(test::tries(20000), [&] { return 0.1 * random.below(4); }), test::tries(500));
}

/// Crossings in a crumpled cloth, as pairs of triangles without a common vertex.
TEST(Cgal, FindsTheSameTrianglesThatCross) {
  const Mesh grid = make_grid(8, 8);
  const Topology topology = make_topology(grid.triangles);
  test::Random random(7);
  std::size_t count = 0;
  for (int i = 0; i < test::tries(20); ++i) {
    const Vertices x = shaken_grid(grid, 0.2, random);
    const auto solid = [&](const Triangle& t) {
      const auto at = [&](int v) { return point(x.row(v).transpose()); };
      return Kernel::Triangle_3(at(t[0]), at(t[1]), at(t[2]));
    };
    const auto has = [](const Triangle& t, int v) { return v == t[0] || v == t[1] || v == t[2]; };
    const auto apart = [&](const Triangle& s, const Triangle& t) {
      return std::ranges::none_of(s, [&](int v) { return has(t, v); });
    };
    std::set<std::pair<Triangle, Triangle>> expected, found;
    for (const Triangle& s : topology.triangles) {
      for (const Triangle& t : topology.triangles) {
        if (apart(s, t) && CGAL::do_intersect(solid(s), solid(t))) expected.emplace(s, t);
      }
    }
    for (const Crossing& crossing : find_crossings({topology, x})) {
      for (const Triangle& s : topology.triangles) {
        const Triangle& t = crossing.triangle;
        if (!has(s, crossing.edge[0]) || !has(s, crossing.edge[1]) || !apart(s, t)) continue;
        found.emplace(s, t);
        found.emplace(t, s);
      }
    }
    EXPECT_EQ(found, expected);
    count += expected.size();
  }
  EXPECT_GT(count, static_cast<std::size_t>(test::tries(300)));
}

#else

TEST(Cgal, AgreesAboutIntersections) { GTEST_SKIP() << "built without CGAL: libcgal-dev"; }

#endif

}  // namespace
}  // namespace drape::audit
