// The filter of pairs: never rejects a pair that comes within the reach, and rejects most others.

#include "sim/collision/candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/random.hpp"
#include "tests/unit/kernels_version.hpp"

namespace drape::test {
namespace {

constexpr Feature pair_kinds[] = {Feature::vertex_triangle, Feature::edge_edge};

/// Pairs with straight paths, four vertices each.
struct Paths {
  std::vector<Point> from, to;

  void add(const FourPoints& start, const FourPoints& end) {
    from.insert(from.end(), start.begin(), start.end());
    to.insert(to.end(), end.begin(), end.end());
  }
  [[nodiscard]] std::size_t count() const { return from.size() / 4; }
  [[nodiscard]] std::vector<FeaturePair> pairs(Feature feature) const {
    std::vector<FeaturePair> pairs;
    for (int v = 0; v < static_cast<int>(from.size()); v += 4) pairs.push_back({feature, {v, v + 1, v + 2, v + 3}});
    return pairs;
  }
  /// Returns the least distance of a pair at some moments, the start and the end included.
  [[nodiscard]] double least_distance(const FeaturePair& pair) const {
    constexpr int moments = 20;
    const FourPoints start = gather(from, pair.vertices), end = gather(to, pair.vertices);
    double squared = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= moments; ++k) {
      const double t = static_cast<double>(k) / moments;
      FourPoints p;
      for (std::size_t i = 0; i < 4; ++i) p[i] = (1 - t) * start[i] + t * end[i];
      squared = std::min(squared, nearest(pair.feature, p).squared);
    }
    return std::sqrt(squared);
  }
};

std::size_t count_near(const PairFilter& filter, Feature feature, std::span<const FeaturePair> pairs, double reach) {
  std::size_t count = 0;
  filter.for_near(feature, pairs, reach, [&](const FeaturePair&) { ++count; });
  return count;
}

/// Returns small features in a box of half width 1: any, parallel, flat, without length or area, on one line, touching.
FourPoints features(Random& random, int kind) {
  const double size = std::pow(10, random.between(-6, 0));
  const Point at = random_point(random);
  FourPoints p;
  for (Point& point : p) point = at + size * random_point(random);
  if (kind == 1) p[3] = p[2] + random.between(-2, 2) * (p[1] - p[0]);
  if (kind == 2) p[3] = p[0] + random.between(-2, 2) * (p[1] - p[0]) + random.between(-2, 2) * (p[2] - p[0]);
  if (kind == 3) p[3] = p[2];
  if (kind == 4) p[1] = p[2] = p[3];
  if (kind == 5) p[0] = p[1];
  if (kind == 6) p[3] = p[2] + random.between(-2, 2) * (p[2] - p[1]);
  if (kind == 7) p[2] = p[0];
  return p;
}
constexpr int kinds = 8;

// The reach is the least distance itself: a bound of the rounding error that is too small would reject the pair.
TEST(PairFilter, KeepsEveryPairThatComesWithinTheReach) {
  Random random;
  for (const double shift : {0.0, 1e4}) {
    Paths paths;
    for (int k = 0; k < tries(20000); ++k) {
      const FourPoints start = features(random, k % kinds);
      FourPoints end = start;
      const double speed = k % 3 == 0 ? 0 : std::pow(10, random.between(-6, 0));
      const Point together = k % 5 == 0 ? Point(0, 0, 0) : random_point(random);
      for (Point& p : end) p += together + speed * random_point(random);
      paths.add(start, end);
    }
    for (std::vector<Point>* points : {&paths.from, &paths.to}) {
      for (Point& p : *points) p += shift * Point(1, -2, 3);
    }
    PairFilter filter;
    filter.set(paths.from, paths.to);
    for (const Feature feature : pair_kinds) {
      const std::vector<FeaturePair> pairs = paths.pairs(feature);
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        ASSERT_EQ(count_near(filter, feature, std::span(pairs).subspan(k, 1), paths.least_distance(pairs[k])), 1U)
            << "pair " << k << " at " << shift;
      }
    }
  }
}

// Parallel slabs are the worst case: no axis is better, and both distances are known without an error.
TEST(PairFilter, KeepsLayersAtTheReachAndRejectsThoseBeyond) {
  constexpr double reach = 0.01;
  for (const Feature feature : pair_kinds) {
    const bool edges = feature == Feature::edge_edge;
    for (const double apart : {reach, 1.01 * reach}) {
      Paths paths;
      Random random;
      for (int k = 0; k < tries(2000); ++k) {
        const Point at = random_point(random), side(0.02, 0, 0), other(0, 0.02, 0), up(0, 0, apart);
        const Point turned = random.between(-1, 1) * side + other;
        const FourPoints p = edges ? FourPoints{at - side + up, at + side + up, at - turned, at + turned}
                                   : FourPoints{at + up, at - side - other, at + side - other, at + other};
        paths.add(p, p);
      }
      PairFilter filter;
      filter.set(paths.from, paths.to);
      EXPECT_EQ(count_near(filter, feature, paths.pairs(feature), reach), apart > reach ? 0 : paths.count());
    }
  }
}

// Features that stay at 1.05 of the reach or more are rejected, unless they are large and move past each other.
TEST(PairFilter, RejectsMostDistantPairs) {
  Random random;
  Paths paths;
  for (int k = 0; k < tries(20000); ++k) {
    FourPoints start, end;
    const Point at = random_point(random), together = random_point(random);
    for (std::size_t i = 0; i < 4; ++i) {
      start[i] = at + 0.1 * random_point(random);
      end[i] = start[i] + together + 0.001 * random_point(random);
    }
    paths.add(start, end);
  }
  PairFilter filter;
  filter.set(paths.from, paths.to);
  for (const Feature feature : pair_kinds) {
    std::size_t distant = 0, kept = 0;
    const std::vector<FeaturePair> pairs = paths.pairs(feature);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double distance = paths.least_distance(pairs[k]);
      if (distance < 0.01) continue;
      ++distant;
      kept += count_near(filter, feature, std::span(pairs).subspan(k, 1), distance / 1.05);
    }
    EXPECT_GT(distant, pairs.size() / 2);
    EXPECT_LT(kept, distant / 100);
  }
}

TEST(PairFilter, RejectsNothingThatIsNotFinite) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (std::size_t vertex = 0; vertex < 4; ++vertex) {
      FourPoints p{Point(0, 0, 9), Point(1, 0, 9), Point(0, 1, 0), Point(1, 1, 0)};
      p[vertex].y() = bad;
      Paths paths;
      paths.add(p, p);
      PairFilter filter;
      filter.set(paths.from, paths.to);
      for (const Feature feature : pair_kinds) EXPECT_EQ(count_near(filter, feature, paths.pairs(feature), 1), 1U);
    }
  }
}

class PairKernels : public KernelsVersion {};

INSTANTIATE_TEST_SUITE_P(For, PairKernels, testing::ValuesIn(all_kernels().begin(), all_kernels().end()),
                         [](const auto& info_) { return std::string(info_.param->name); });

TEST_P(PairKernels, FindsTheSameNearPairs) {
  Random random;
  std::vector<float> rows;
  std::vector<int> vertices;
  for (int k = 0; k < 256; ++k) {
    const FourPoints start = features(random, k % kinds), end = features(random, k % kinds);
    for (std::size_t i = 0; i < 4; ++i) {
      vertices.push_back(4 * k + static_cast<int>(i));
      for (const Point& p : {start[i], end[i]}) {
        for (const double x : {p.x(), p.y(), p.z(), 0.0}) rows.push_back(static_cast<float>(x));
      }
    }
  }
  std::size_t found = 0;
  for (const int count : counts) {
    const PairPaths pairs{.rows = rows.data(), .vertices = vertices.data(), .stride = 4, .count = count, .reach = 0.3F};
    for (const auto find : {&Kernels::near_edges, &Kernels::near_vertices}) {
      std::vector<int> a(256, -1), b = a;
      ASSERT_EQ((reference.*find)(pairs, a.data()), (tested.*find)(pairs, b.data())) << count << " pairs";
      ASSERT_EQ(a, b) << count << " pairs";
      found += static_cast<std::size_t>(std::ranges::count_if(a, [](int number) { return number >= 0; }));
    }
  }
  EXPECT_GT(found, 100U);
}

}  // namespace
}  // namespace drape::test
