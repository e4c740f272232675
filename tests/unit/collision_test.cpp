// Parts of self-collision: distances, times of impact, candidates, rigid zones.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/collision/candidates.hpp"
#include "sim/collision/distance.hpp"
#include "sim/contact/impulse_contact.hpp"
#include "sim/contact/mesh_contacts.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

constexpr Feature both[] = {Feature::vertex_triangle, Feature::edge_edge};

FourPoints random_points(Random& random) {
  return {random_point(random), random_point(random), random_point(random), random_point(random)};
}

/// Returns the least distance of n² sampled points of each feature.
double sampled_distance(Feature feature, const FourPoints& p, int n) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double s = static_cast<double>(i) / n, t = static_cast<double>(j) / n;
      const Point d = feature == Feature::edge_edge
                          ? Point((1 - s) * p[0] + s * p[1] - (1 - t) * p[2] - t * p[3])
                          : Point(p[0] - p[1] - s * (p[2] - p[1]) - (1 - s) * t * (p[3] - p[1]));
      least = std::min(least, d.norm());
    }
  }
  return least;
}

void expect_nearest(Feature feature, const FourPoints& p) {
  const Nearest found = nearest(feature, p);
  constexpr int n = 100;
  double size = 0;
  for (const Point& q : p) size = std::max(size, (q - p[2]).norm());
  const double distance = std::sqrt(found.squared), sampled = sampled_distance(feature, p, n);
  EXPECT_LE(distance, sampled + 1e-12 * size);
  EXPECT_GE(distance, sampled - 3 * size / n);  // a sample is at most this far from the closest point
  EXPECT_NEAR(found.difference(p).norm(), distance, 1e-12 * (size + p[0].norm()));
  const auto& w = found.weights;
  const double first = feature == Feature::edge_edge ? w[0] + w[1] : w[0];
  EXPECT_NEAR(first, 1, 1e-12);
  EXPECT_NEAR(w[0] + w[1] + w[2] + w[3], 0, 1e-12);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(std::isfinite(w[i]));
}

TEST(Nearest, IsNoFurtherThanAnyOtherPoints) {
  Random random;
  for (const Feature feature : both) {
    for (int i = 0; i < tries(200); ++i) expect_nearest(feature, random_points(random));
  }
}

TEST(Nearest, KnowsDegenerateAndParallelFeatures) {
  const Point o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  for (const Feature feature : both) {
    expect_nearest(feature, {z, o, x, 2 * x});              // a degenerate triangle; coplanar edges
    expect_nearest(feature, {z, o, o, o});                  // a triangle or an edge that is a point
    expect_nearest(feature, {o, x, y, x + y});              // parallel
    expect_nearest(feature, {o, x, y + 2 * x, y + 3 * x});  // parallel, one behind the other
    expect_nearest(feature, {o, 2 * x, x, 3 * x});          // on one line
    expect_nearest(feature, {o, x, o, y});                  // touching
    expect_nearest(feature, {y, y, o, x});
    expect_nearest(feature, {o, x, 1e-9 * y, x + 1e-9 * z});
  }
}

// Two edges that cross at a height are that far apart, at any angle.
TEST(Nearest, OfCrossingEdgesIsWhereTheyCross) {
  for (const double height : {0.0, 1e-3, 1.0}) {
    for (const double angle : {1.0, 0.1, 0.05, 1e-2, 1e-4, 1e-6}) {
      const Point across(std::cos(angle), std::sin(angle), 0), up(0, 0, height);
      const FourPoints p{Point(-1, 0, 0), Point(2, 0, 0), up - across, up + 3 * across};
      const Nearest found = nearest(Feature::edge_edge, p);
      EXPECT_NEAR(std::sqrt(found.squared), height, 1e-15) << angle;
      EXPECT_NEAR(found.weights[1], 1.0 / 3, 1e-14 / angle) << angle;
      EXPECT_NEAR(found.weights[3], -1.0 / 4, 1e-14 / angle) << angle;
    }
  }
}

FourPoints moved(const FourPoints& p, const FourPoints& move, double t) {
  FourPoints result = p;
  for (std::size_t i = 0; i < 4; ++i) result[i] += t * move[i];
  return result;
}

double distance(Feature feature, const FourPoints& p) { return std::sqrt(nearest(feature, p).squared); }

// A vertex at height one, descending by `way`, touches a triangle at 1/way. A tenth of the gap left counts as impact.
TEST(TimeOfImpact, OfAFallingVertexIsKnown) {
  const Point o(0, 0, 0), down(0, 0, -1);
  const FourPoints p{Point(0.2, 0.2, 1), o, Point(1, 0, 0), Point(0, 1, 0)};
  for (const double way : {0.95, 1.0, 1.5, 2.0, 100.0}) {
    const auto time = time_of_impact(Feature::vertex_triangle, p, {way * down, o, o, o});
    ASSERT_TRUE(time) << way;
    EXPECT_LT(*time, 1 / way);
    EXPECT_LE(distance(Feature::vertex_triangle, moved(p, {way * down, o, o, o}, *time)), kept_gap * (1 + 1e-9));
  }
  EXPECT_FALSE(time_of_impact(Feature::vertex_triangle, p, {0.85 * down, o, o, o}));
  EXPECT_FALSE(time_of_impact(Feature::vertex_triangle, p, {-100 * down, o, o, o}));
  EXPECT_FALSE(time_of_impact(Feature::vertex_triangle, p, {9 * down, 9 * down, 9 * down, 9 * down}));
  EXPECT_FALSE(time_of_impact(Feature::vertex_triangle, p, {Point(5, 0, -1), o, o, o})) << "passes beside it";
}

// For any distance and any length of the motion.
TEST(TimeOfImpact, ThereIsNoneWhereFeaturesSlideAlongEachOther) {
  const Point o(0, 0, 0);
  for (const double height : {1e-3, 1e-5, 1e-7}) {
    const FourPoints vertex{Point(0.1, 0.1, height), o, Point(1, 0, 0), Point(0, 1, 0)};
    EXPECT_FALSE(time_of_impact(Feature::vertex_triangle, vertex, {Point(0.5, 0.2, 0), o, o, o})) << height;
    const FourPoints edges{Point(-1, 0, height), Point(1, 0.1, height), Point(0, -1, 0), Point(0, 1, 0)};
    EXPECT_FALSE(time_of_impact(Feature::edge_edge, edges, {Point(0, 0.5, 0), Point(0.2, 0.5, 0), o, o})) << height;
  }
}

TEST(TimeOfImpact, OfCrossingEdgesIsKnown) {
  const Point o(0, 0, 0), down(0, 0, -3);
  const FourPoints p{Point(-1, 0, 1), Point(1, 0, 1), Point(0, -1, 0), Point(0, 1, 0)};
  const auto time = time_of_impact(Feature::edge_edge, p, {down, down, o, o});
  ASSERT_TRUE(time);
  EXPECT_NEAR(*time, 0.3, 0.03);
  EXPECT_FALSE(time_of_impact(Feature::edge_edge, p, {o, o, down, down}));
}

// Steps that end early approach an obstacle ever more closely. However many there are, the gap stays far larger than
// the rounding of a metre.
TEST(Touch, LeavesAGapWhateverTheNumberOfShortenedSteps) {
  const Point o(0, 0, 0), down(0.1, 0.2, -1);
  for (const Feature feature : both) {
    const FourPoints rest = feature == Feature::edge_edge
                                ? FourPoints{Point(-1, 0, 1), Point(1, 0, 1), Point(0, -1, 0), Point(0, 1, 0)}
                                : FourPoints{Point(0.2, 0.2, 1), o, Point(1, 0, 0), Point(0, 1, 0)};
    FourPoints p = rest;
    const double thickness = 0.005;
    for (int step = 0; step < 200; ++step) {
      FourPoints to = p;
      for (double part = 1; part > 0; part /= 2) {
        to[0] = p[0] + part * down;
        if (feature == Feature::edge_edge) to[1] = p[1] + part * down;
        const auto touch = find_touch({feature, p, to, distance(feature, p)}, thickness, false);
        if (!touch || !touch->collides) break;
        to = p;
      }
      p = to;
    }
    EXPECT_GT(p[0].z(), 1e-6 * thickness / 10);
    EXPECT_LT(p[0].z(), thickness);
    const auto resting = find_touch({feature, p, p, distance(feature, p)}, thickness, true);
    EXPECT_TRUE(resting && !resting->collides);
    FourPoints up = p;
    up[0].z() += 1e-3;
    if (feature == Feature::edge_edge) up[1].z() += 1e-3;
    const auto leaving = find_touch({feature, p, up, distance(feature, p)}, thickness, true);
    EXPECT_TRUE(leaving && !leaving->collides) << "leaves as far as it likes";
  }
}

// The cubic of four coplanar points is always zero, but distances still determine an impact.
TEST(TimeOfImpact, KnowsMotionsWithinAPlane) {
  const Point o(0, 0, 0), right(4, 0, 0);
  const FourPoints vertex{Point(-1, 0.2, 0), o, Point(1, 0, 0), Point(0, 1, 0)};
  EXPECT_TRUE(time_of_impact(Feature::vertex_triangle, vertex, {right, o, o, o})) << "through the whole triangle";
  const FourPoints parallel{Point(-1, 0, 0), Point(-1, 1, 0), Point(1, 0, 0), Point(1, 1, 0)};
  EXPECT_TRUE(time_of_impact(Feature::edge_edge, parallel, {right, right, o, o}));
  EXPECT_FALSE(time_of_impact(Feature::edge_edge, parallel, {o, o, right, right}));
  const FourPoints line{Point(-2, 0, 0), Point(-1, 0, 0), Point(1, 0, 0), Point(2, 0, 0)};
  EXPECT_TRUE(time_of_impact(Feature::edge_edge, line, {right, right, o, o}));
}

TEST(TimeOfImpact, KnowsDegenerateFeatures) {
  const Point o(0, 0, 0), down(0, 0, -2), a(0, 0, 1);
  EXPECT_TRUE(time_of_impact(Feature::edge_edge, {a, a, o, o}, {down, down, o, o})) << "two points";
  EXPECT_TRUE(time_of_impact(Feature::vertex_triangle, {a, o, o, o}, {down, o, o, o}));
  EXPECT_FALSE(time_of_impact(Feature::edge_edge, {a, a, o, o}, {o, o, o, o})) << "nothing moves";
  EXPECT_FALSE(time_of_impact(Feature::edge_edge, {o, a, o, a}, {down, o, o, o})) << "touch from the start";
}

// No impact between tested times is missed: checked at a thousand times of random motions of any size.
TEST(TimeOfImpact, MissesNothing) {
  Random random;
  int impacts = 0;
  for (int i = 0; i < tries(2000); ++i) {
    const Feature feature = both[i % 2];
    const FourPoints p = random_points(random);
    FourPoints move = random_points(random);
    for (Point& m : move) m *= i % 7 == 0 ? 20 : 1.5;
    const double gap = kept_gap * distance(feature, p);
    const auto time = time_of_impact(feature, p, move);
    impacts += time ? 1 : 0;
    const double until = time.value_or(1);
    for (int k = 0; k <= 1000; ++k) {
      const double t = k / 1000.0 * until;
      if (t >= 0.999 * until) continue;
      ASSERT_GT(distance(feature, moved(p, move, t)), gap * (1 - 1e-9)) << "case " << i << ", t = " << t;
    }
  }
  EXPECT_GT(impacts, tries(2000) / 20);
}

// All pairs that come near are among the candidates.
TEST(CollisionCandidates, ContainEveryPairThatComesNear) {
  constexpr double reach = 0.08;
  const Cloth cloth = cloth_of(irregular_mesh(7), 1, 1, {3, 4, 5, 6});
  std::vector<Point> from, to;
  const Vertices crumple = random_vertices(cloth.vertex_count(), 3), way = random_vertices(cloth.vertex_count(), 4);
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    from.push_back((cloth.positions.row(i) + 0.2 * crumple.row(i)).transpose());
    to.push_back(from.back() + 0.2 * way.row(i).transpose());
  }
  CollisionCandidates candidates(cloth);
  candidates.find(from, to, reach);
  const std::vector<FeaturePair>& pairs = candidates.pairs();
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  int near = 0;
  const auto expect = [&](const FeaturePair& pair) {
    FourPoints p, move;
    for (std::size_t i = 0; i < 4; ++i) {
      p[i] = from[static_cast<std::size_t>(pair.vertices[i])];
      move[i] = to[static_cast<std::size_t>(pair.vertices[i])] - p[i];
    }
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 10; ++k) least = std::min(least, distance(pair.feature, moved(p, move, k / 10.0)));
    if (least > reach) return;
    ++near;
    EXPECT_EQ(std::count(pairs.begin(), pairs.end(), pair), 1);
  };
  const std::vector<Edge> edges = unique_edges(cloth.triangles);
  for (const Edge& e : edges) {
    for (const Triangle& t : cloth.triangles) {
      const int v = e[0];
      if (v != t[0] && v != t[1] && v != t[2]) expect({Feature::vertex_triangle, {v, t[0], t[1], t[2]}});
    }
    for (const Edge& f : edges) {
      if (e < f && e[0] != f[0] && e[0] != f[1] && e[1] != f[0] && e[1] != f[1]) {
        expect({Feature::edge_edge, {e[0], e[1], f[0], f[1]}});
      }
    }
  }
  EXPECT_GT(near, 100);
  EXPECT_LT(pairs.size(), edges.size() * cloth.triangles.size() / 4) << "nothing was left out";
}

TEST(RigidZones, KeepBothMomentaAndBringNoPointsNearer) {
  constexpr int count = 12;
  Random random;
  std::vector<Point> x, velocities;
  std::vector<double> inverse_masses;
  for (int i = 0; i < count; ++i) {
    x.push_back(random_point(random));
    velocities.push_back(10 * random_point(random));
    inverse_masses.push_back(1 + random.number());
  }
  const std::vector<Point> before = velocities;
  move_rigidly({{0, 1, 2, 3}, {3, 4, 5, 6}}, false, x, inverse_masses, velocities);
  Point p = Point::Zero(), l = p;
  for (std::size_t i = 0; i < count; ++i) {
    const Point change = (velocities[i] - before[i]) / inverse_masses[i];
    if (i > 6) {
      EXPECT_EQ(change, Point::Zero());
    }
    p += change;
    l += x[i].cross(change);
  }
  EXPECT_LT(p.norm(), 1e-12);
  EXPECT_LT(l.norm(), 1e-12);
  for (std::size_t i = 0; i < 7; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Point d = x[i] - x[j], way = velocities[i] - velocities[j];
      for (const double t : {0.01, 0.1, 1.0}) EXPECT_GE((d + t * way).norm(), d.norm() * (1 - 1e-12));
    }
  }
}

TEST(RigidZones, MoveWithTheirPin) {
  std::vector<Point> velocities{Point(1, 0, 0), Point(0, 5, 0), Point(0, 0, 7), Point(3, 3, 3)};
  const std::vector<Point> x{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
  move_rigidly({{0, 1, 2, 3}}, false, x, {0, 1, 1, 1}, velocities);
  for (const Point& v : velocities) EXPECT_EQ(v, Point(1, 0, 0));
}

}  // namespace
}  // namespace drape::test
