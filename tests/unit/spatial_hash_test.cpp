#include "sim/collision/spatial_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "sim/collision/distance.hpp"
#include "tests/support/random.hpp"

namespace drape::spatial_hash {
namespace {

/// Calls visit(k, l), k < l, for every two overlapping boxes.
void for_pairs(const SpatialHash& hash, int boxes, auto&& visit) {
  for (int k = 0; k < boxes; ++k) hash.for_later(k, [&](int l) { visit(k, l); });
}

TEST(SpatialHash, FindsEveryOverlapOnce) {
  test::Random random;
  for (const double huge : {0.0, 50.0}) {
    std::vector<Box> boxes;
    for (int i = 0; i < 300; ++i) {
      const Point low = test::random_point(random);
      const Point size = 0.15 * (test::random_point(random) + Point::Ones());
      boxes.emplace_back(low, low + size);
      if (i % 100 == 0) boxes.back().max() += huge * Point(1, 0.5, 1);  // one that reaches far beyond the others
    }
    SpatialHash hash;
    hash.build(boxes);
    std::vector<std::pair<int, int>> expected, pairs, queried;
    for (int k = 0; k < 300; ++k) {
      for (int l = k + 1; l < 300; ++l) {
        if (boxes[static_cast<std::size_t>(k)].intersects(boxes[static_cast<std::size_t>(l)]))
          expected.emplace_back(k, l);
      }
    }
    for_pairs(hash, 300, [&](int k, int l) { pairs.emplace_back(k, l); });
    for (int k = 0; k < 300; ++k) {
      hash.for_overlapping(boxes[static_cast<std::size_t>(k)], [&](int l) {
        if (k < l) queried.emplace_back(k, l);
      });
    }
    std::sort(pairs.begin(), pairs.end());
    std::sort(queried.begin(), queried.end());
    ASSERT_GT(expected.size(), 100U);
    EXPECT_EQ(pairs, expected);
    EXPECT_EQ(queried, expected);
  }
}

TEST(SpatialHash, TakesBoxesInOnePlaceAndFarApart) {
  SpatialHash hash;
  int found = 0;
  const auto count = [&](int, int) { ++found; };
  const std::vector<Box> same(5, Box{Point(1, 2, 3), Point(1, 2, 3)});
  hash.build(same);
  for_pairs(hash, 5, count);
  EXPECT_EQ(found, 10);
  found = 0;
  const std::vector<Box> far{{Point(0, 0, 0), Point(1, 1, 1)},
                             {Point::Constant(1e200), Point::Constant(1e201)},
                             {Point(0.5, 0.5, 0.5), Point(2, 2, 2)}};
  hash.build(far);
  for_pairs(hash, 3, count);
  EXPECT_EQ(found, 1);
  found = 0;
  hash.build({});
  hash.for_overlapping(far.front(), [&](int k) { count(k, k); });
  EXPECT_EQ(found, 0);
}

}  // namespace
}  // namespace drape::spatial_hash
