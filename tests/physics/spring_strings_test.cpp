#include "sim/effects/strain_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

std::vector<StringLink> strings_of(const Cloth& cloth) {
  std::vector<std::size_t> all(cloth.springs.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return lay_out_strings(cloth, all);
}

TEST(SpringStrings, HaveEachSpringOnceAndGoOnWhereTheyAreJoined) {
  const Cloth cloth = cloth_of(irregular_mesh(8), 1, 5, {});
  const std::vector<StringLink> links = strings_of(cloth);
  std::vector<int> times(cloth.springs.size(), 0);
  for (std::size_t k = 0; k < links.size(); ++k) {
    const Spring& s = cloth.springs[links[k].spring];
    EXPECT_EQ(std::minmax(links[k].from, links[k].to), std::minmax(s.i, s.j));
    ++times[links[k].spring];
    if (links[k].joined) {
      EXPECT_EQ(links[k].from, links[k - 1].to);
    }
  }
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), static_cast<std::ptrdiff_t>(times.size()));
}

// n + 1 lines in each direction, and 2n − 1 diagonals.
TEST(SpringStrings, AreTheLinesAndDiagonalsOfAGrid) {
  const std::vector<StringLink> links = strings_of(cloth_of(make_grid(7, 7), 1, 5, {}));
  EXPECT_EQ(std::count_if(links.begin(), links.end(), [](const StringLink& link) { return !link.joined; }), 8 + 8 + 13);
}

// A chain whose first link is too long: each next link must pull more, and one pass finds all tensions. A link so short
// that it would have to push stays slack.
TEST(SpringStrings, BalanceAChainAtOnce) {
  constexpr int count = 20;
  const auto chain = [](double end) {
    std::vector<Tension> string;
    for (int k = 0; k < count; ++k) {
      const bool top = k == 0;
      string.push_back({.along = Eigen::Vector3d::UnitZ(),
                        .weight = top ? 1.0 : 2.0,
                        .coupling = top ? 0.0 : 1.0,
                        .excess = top ? 1.0 : 0.0,
                        .pull = 1});
    }
    string.back().excess = end;
    return string;
  };
  // The remaining excess is bounded by a link's tolerance.
  for (const double end : {0.0, -3.0}) {
    const std::vector<Tension> before = chain(end);
    std::vector<Tension> after = before;
    balance(after);
    for (std::size_t k = 0; k < before.size(); ++k) {
      const double above = k > 0 ? before[k].coupling * after[k - 1].more : 0;
      const double below = k + 1 < before.size() ? before[k + 1].coupling * after[k + 1].more : 0;
      const double left = before[k].excess - before[k].weight * after[k].more + above + below;
      EXPECT_GE(before[k].pull + after[k].more, 0) << k;
      EXPECT_LE(left, 2e-3 * before[k].weight * std::abs(after[k].more) + 1e-12) << k;
      if (before[k].pull + after[k].more > 0) {
        EXPECT_GE(left, -2e-3 * before[k].weight * std::abs(after[k].more) - 1e-12) << k;
      }
    }
    EXPECT_EQ(after.back().more == -1, end < 0);
  }
}

}  // namespace
}  // namespace drape::test
