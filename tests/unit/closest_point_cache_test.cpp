// Caches for points beside a mesh, and for a cloth's triangles beside a body, do not change results.

#include "sim/collision/closest_point_cache.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "drape/sim/effects/body.hpp"
#include "sim/collision/candidates.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

/// A mesh that moves repeatedly, by decreasing amounts.
class Wobbling {
 public:
  explicit Wobbling(const Mesh& mesh)
      : topology(std::make_shared<MeshTopology>(mesh.triangles, static_cast<int>(mesh.positions.rows()))),
        x(mesh.positions),
        now(topology, x),
        before(now) {}
  void move(double by) {
    before = now;
    const Vertices was = x;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      for (int axis = 0; axis < 3; ++axis) x(i, axis) += by * shift(random);
    }
    travel += (x - was).rowwise().norm().maxCoeff();
    now.place(x, travel);
  }

  std::mt19937 random{5};
  std::uniform_real_distribution<double> shift{-1, 1};
  std::shared_ptr<const MeshTopology> topology;
  Vertices x;
  double travel = 0;
  PlacedMesh now, before;
};

TEST(ClosestPointCache, FindsTheVeryFootThatASearchFinds) {
  const double reach = 0.1;
  for (const Mesh& mesh : {make_box({1, 0.7, 0.3}), make_grid(9, 9), make_grid(1, 1)}) {
    Wobbling body(mesh);
    ClosestPointCache memory(40, reach);
    std::vector<Point> points(40);
    for (Point& p : points) p = Point(body.shift(body.random), body.shift(body.random), 0.2 * body.shift(body.random));
    int closest_points = 0;
    for (int step = 0; step < 600; ++step) {
      const double by = 0.1 * std::pow(10.0, -(step % 5));
      if (step % 7 == 0) body.move(0.1 * by);
      for (std::size_t k = 0; k < points.size(); ++k) {
        points[k] += by * Point(body.shift(body.random), body.shift(body.random), body.shift(body.random));
        const auto plain = body.now.find(points[k], reach);
        ClosestPoint closest;
        const bool found = memory.find(body.now, k, points[k], closest);
        ASSERT_EQ(found, plain && plain->distance < reach) << step << " " << k;
        if (!found) continue;
        ++closest_points;
        ASSERT_EQ(closest.triangle, plain->triangle) << step << " " << k;
        ASSERT_EQ(closest.weights, plain->weights);
        ASSERT_EQ(closest.normal, plain->normal);
        ASSERT_EQ(closest.distance, plain->distance);
      }
    }
    EXPECT_GT(closest_points, 1000);
  }
}

TEST(ClosestPointCache, DoesNotForgetWhatItHasLeftOut) {
  // Around a box's edges, which are closest to one position but, two reaches farther, not to the other.
  const double reach = 0.02;
  const Wobbling body(make_box({0.4, 0.4, 0.6}));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-1, 1);
  int closest_points = 0;
  for (int round = 0; round < 4000; ++round) {
    Point p(0.2 + reach * shift(random), 0.2 + reach * shift(random), 0.3 * shift(random));
    ClosestPointCache memory(1, reach);
    for (int look = 0; look < 4; ++look) {
      const auto plain = body.now.find(p, reach);
      ClosestPoint closest;
      const bool found = memory.find(body.now, 0, p, closest);
      ASSERT_EQ(found, plain && plain->distance < reach) << round;
      p += 2 * reach * Point(shift(random), shift(random), shift(random));
      if (!found) continue;
      ++closest_points;
      ASSERT_EQ(closest.triangle, plain->triangle) << round;
      ASSERT_EQ(closest.distance, plain->distance) << round;
    }
  }
  EXPECT_GT(closest_points, 1000);
}

TEST(ClosestPointCache, KnowsACornerOfMoreTrianglesThanItKeeps) {
  // A cone of thirty triangles, and points above its tip.
  Mesh cone;
  const int sides = 30;
  cone.positions = Vertices::Zero(sides + 1, 3);
  for (int k = 0; k < sides; ++k) {
    cone.positions.row(k + 1) << std::cos(0.2 * k), std::sin(0.2 * k), -0.3;
    cone.triangles.push_back({0, 1 + k, 1 + (k + 1) % sides});
  }
  Wobbling body(cone);
  ClosestPointCache memory(1, 0.2);
  for (int step = 0; step < 200; ++step) {
    const Point p = 0.05 * Point(body.shift(body.random), body.shift(body.random), 2);
    const auto plain = body.now.find(p, 0.2);
    ClosestPoint closest;
    ASSERT_TRUE(memory.find(body.now, 0, p, closest));
    EXPECT_EQ(closest.triangle, plain->triangle);
    EXPECT_EQ(closest.normal, plain->normal);
  }
}

/// Returns the pairs of features that are within reach at the start or end of a step.
std::set<FeaturePair> near_pairs(const Cloth& cloth, const MeshTopology& body, const BodyStep& step, double reach) {
  const int first = cloth.vertex_count();
  std::vector<Triangle> triangles = body.triangles;
  for (Triangle& t : triangles) {
    for (int& i : t) i += first;
  }
  std::set<FeaturePair> found;
  const auto look = [&](const FeaturePair& pair) {
    for (const auto* at : {&step.from, &step.to}) {
      if (nearest(pair.feature, gather(*at, pair.vertices)).squared < reach * reach) found.insert(pair);
    }
  };
  const auto vertices_of = [](const std::vector<Triangle>& all) {
    std::set<int> vertices;
    for (const Triangle& t : all) vertices.insert(t.begin(), t.end());
    return vertices;
  };
  for (const int i : vertices_of(cloth.triangles)) {
    for (const Triangle& t : triangles) look({Feature::vertex_triangle, {i, t[0], t[1], t[2]}});
  }
  for (const int i : vertices_of(triangles)) {
    for (const Triangle& t : cloth.triangles) look({Feature::vertex_triangle, {i, t[0], t[1], t[2]}});
  }
  for (const Edge& a : unique_edges(cloth.triangles)) {
    for (const Edge& b : unique_edges(triangles)) look({Feature::edge_edge, {a[0], a[1], b[0], b[1]}});
  }
  return found;
}

/// Returns a pair with ordered edges.
FeaturePair sorted(FeaturePair pair) {
  auto& v = pair.vertices;
  if (pair.feature == Feature::edge_edge) {
    if (v[0] > v[1]) std::swap(v[0], v[1]);
    if (v[2] > v[3]) std::swap(v[2], v[3]);
  }
  return pair;
}

/// Moves a cloth up and down above a wobbling body, and expects all near pairs.
void expect_to_miss_nothing(const Mesh& shape) {
  const double reach = 0.03;
  Mesh mesh = make_grid(4, 4);
  mesh.positions.col(2).array() += 0.1;
  Wobbling body(shape);
  const Cloth cloth = cloth_of(mesh, 1, 10, {});
  const std::size_t count = body.now.points().size(), first = static_cast<std::size_t>(mesh.positions.rows());
  BodyCandidates candidates(*body.topology, static_cast<int>(count), cloth, 0.05);
  std::vector<Point> from(first + count), to(first + count);
  for (std::size_t i = 0; i < first; ++i) to[i] = cloth.positions.row(static_cast<Eigen::Index>(i)).transpose();
  std::size_t met = 0;
  for (int step = 0; step < tries(160); ++step) {
    const double by = 0.1 * std::pow(10.0, -(step % 4));
    body.move(0.1 * by);
    for (std::size_t i = 0; i < first; ++i) {
      from[i] = to[i];
      to[i] += by * Point(0, 0, step / 4 % 2 == 0 ? -0.2 : 0.2) +
               0.1 * by * Point(body.shift(body.random), body.shift(body.random), body.shift(body.random));
    }
    for (std::size_t i = 0; i < count; ++i) {
      from[first + i] = body.before.points()[i];
      to[first + i] = body.now.points()[i];
    }
    const BodyStep now{from, to, body.before, body.now};
    candidates.find(now, reach);
    std::set<FeaturePair> found;
    for (const BodyPair& pair : candidates.pairs()) found.insert(sorted(pair.pair));
    const std::set<FeaturePair> expected = near_pairs(cloth, *body.topology, now, reach);
    met += expected.size();
    for (const FeaturePair& pair : expected) ASSERT_TRUE(found.contains(pair)) << "step " << step;
  }
  EXPECT_GT(met, static_cast<std::size_t>(tries(1000)));
}

TEST(BodyCandidates, MissNothingThatComesNearWhateverTheyRemember) {
  expect_to_miss_nothing(make_box({1, 1.2, 0.1}));
  Mesh sheet = make_grid(5, 5);
  sheet.positions.col(2).array() += 0.05;
  expect_to_miss_nothing(sheet);
}

}  // namespace
}  // namespace drape::test
