#include "study/measure.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <numeric>
#include <utility>
#include <vector>

namespace drape {
namespace {

TEST(MedianInterval, OfKnownValues) {
  const MedianInterval odd = median_interval({5, 1, 4, 2, 3});
  EXPECT_EQ(odd.median, 3);
  EXPECT_EQ(odd.count, 5U);
  EXPECT_FALSE(odd.known());
  const MedianInterval even = median_interval({6, 1, 5, 2, 4, 3});
  EXPECT_EQ(even.median, 3.5);
  EXPECT_EQ(even.lower, 1);
  EXPECT_EQ(even.upper, 6);
  EXPECT_EQ(even.times(2).upper, 12);
}

// Hahn and Meeker's table of two-sided 95 % intervals of the median; also table A.18 of Conover, "Practical
// Nonparametric Statistics", for n ≤ 20.
TEST(MedianInterval, BeginsAtTheOrderStatisticsOfTheTables) {
  EXPECT_EQ(first_order_statistic(1), 0U);
  EXPECT_EQ(first_order_statistic(5), 0U);
  for (const auto& [n, l] : std::vector<std::pair<std::size_t, std::size_t>>{
           {6, 1}, {8, 1}, {9, 2}, {11, 2}, {12, 3}, {15, 4}, {20, 6}, {25, 8}, {30, 10}, {50, 18}}) {
    EXPECT_EQ(first_order_statistic(n), l) << n;
  }
}

// By enumeration: in at least 95 % of all 2ⁿ ways for n values to lie below or above the median, the interval holds it;
// the next narrower interval holds it in fewer.
TEST(MedianInterval, HoldsTheMedianAsOftenAsItSays) {
  for (std::size_t n = fewest_for_interval; n <= 16; ++n) {
    std::size_t held = 0, held_by_next = 0;
    const std::size_t ways = std::size_t{1} << n, l = first_order_statistic(n);
    for (std::size_t way = 0; way < ways; ++way) {
      const auto below = static_cast<std::size_t>(std::popcount(way));
      held += below >= l && below <= n - l ? 1 : 0;
      held_by_next += below >= l + 1 && below <= n - l - 1 ? 1 : 0;
    }
    EXPECT_GE(20 * held, 19 * ways) << n;
    EXPECT_LT(20 * held_by_next, 19 * ways) << n;
  }
}

TEST(MedianInterval, DecidesWhenTheRunsAreEnough) {
  const std::vector<double> same(6, 10), few(5, 10);
  EXPECT_TRUE(is_enough(same, {}));
  EXPECT_FALSE(is_enough(few, {}));
  EXPECT_FALSE(is_enough({10, 10, 10, 10, 10, 11}, {}));  // its upper end is 10 % above the median
  std::vector<double> scattered(most_runs);
  std::iota(scattered.begin(), scattered.end(), 1);
  EXPECT_TRUE(is_enough(scattered, {}));
  scattered.pop_back();
  EXPECT_FALSE(is_enough(scattered, {}));
  EXPECT_TRUE(is_enough({1, 2}, 2));
  EXPECT_FALSE(is_enough(same, 7));
}

}  // namespace
}  // namespace drape
