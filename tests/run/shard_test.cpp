#include "run/shard.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

TEST(Shard, IsReadAndRefused) {
  const Shard shard = parse_shard("2/5");
  EXPECT_EQ(shard.number, 2U);
  EXPECT_EQ(shard.count, 5U);
  EXPECT_EQ(shard.text(), "2/5");
  for (const char* wrong : {"", "2", "0/5", "6/5", "2/", "/5", "2/5x", "-1/5", "1/0"}) {
    EXPECT_NE(test::usage_error([&] { parse_shard(wrong); }).find("as in 2/5"), std::string::npos) << wrong;
  }
}

/// Returns the largest load of n shards, and checks that they contain each run once.
double largest_load(const std::vector<double>& costs, std::size_t shards) {
  std::vector<int> seen(costs.size(), 0);
  double largest = 0;
  for (std::size_t k = 1; k <= shards; ++k) {
    double load = 0;
    for (const std::size_t run : runs_of_shard(costs, {k, shards})) {
      ++seen[run];
      load += costs[run];
    }
    largest = std::max(largest, load);
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(costs.size()));
  return largest;
}

TEST(Shards, HaveEveryRunOnceAndAreBalanced) {
  std::mt19937 random(1);
  std::lognormal_distribution<double> cost(0, 2);
  for (const std::size_t runs : {1U, 7U, 40U, 1000U}) {
    std::vector<double> costs(runs);
    for (double& c : costs) c = cost(random);
    const double sum = std::accumulate(costs.begin(), costs.end(), 0.0);
    const double most = *std::max_element(costs.begin(), costs.end());
    for (const std::size_t shards : {1U, 2U, 5U, 64U}) {
      // Graham 1969: assigning the longest first takes at most 4/3 of the optimum.
      const double least = std::max(most, sum / static_cast<double>(shards));
      if (shards == 1 || runs > shards) {
        EXPECT_LE(largest_load(costs, shards), 4.0 / 3 * least + most / 3 + 1e-9);
      }
      if (runs <= shards) {
        EXPECT_DOUBLE_EQ(largest_load(costs, shards), most);
      }
    }
  }
}

}  // namespace
}  // namespace drape
