#include "study/median_interval.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace drape {
namespace {

constexpr double confidence = 0.95, narrow_share = 0.05;

}  // namespace

bool MedianInterval::known() const { return std::isfinite(lower) && std::isfinite(upper); }

bool MedianInterval::narrow() const {
  return known() && median - lower <= narrow_share * median && upper - median <= narrow_share * median;
}

std::size_t first_order_statistic(std::size_t n) {
  // Sum P(B = 0), P(B ≤ 1), … until both tails together exceed 1 − confidence.
  double one = std::exp2(-static_cast<double>(n)), below = one;
  std::size_t l = 0;
  while (2 * below <= 1 - confidence) {
    ++l;
    one *= static_cast<double>(n - l + 1) / static_cast<double>(l);
    below += one;
  }
  return l;
}

MedianInterval median_interval(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size(), half = n / 2;
  MedianInterval interval;
  interval.count = n;
  interval.median = n % 2 == 1 ? values[half] : std::midpoint(values[half - 1], values[half]);
  const std::size_t l = first_order_statistic(n);
  interval.lower = l > 0 ? values[l - 1] : std::numeric_limits<double>::quiet_NaN();
  interval.upper = l > 0 ? values[n - l] : std::numeric_limits<double>::quiet_NaN();
  return interval;
}

bool is_enough(const std::vector<double>& values, RunCount runs) {
  if (values.size() >= static_cast<std::size_t>(runs_at_most(runs))) return true;
  return !runs && values.size() >= fewest_for_interval && median_interval(values).narrow();
}

std::string runs_option(RunCount runs) { return runs ? fmt::format(" --runs {}", *runs) : std::string(); }

std::string describe_runs(RunCount runs) {
  if (!runs) {
    return fmt::format(
        "the median of as many runs as it takes until its interval of 95 % confidence, which is from one run to "
        "another "
        "(order statistics), is within 5 % of it, but no more than {}",
        most_runs);
  }
  return fmt::format("the median of {} run{}{}", *runs, *runs == 1 ? "" : "s",
                     *runs < static_cast<int>(fewest_for_interval)
                         ? ", which are too few for an interval"
                         : " and its interval of 95 % confidence, which is from one run to another (order statistics)");
}

}  // namespace drape
