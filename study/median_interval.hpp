#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace drape {

/// The median of some measurements, with its 95 % confidence interval.
struct MedianInterval {
  double lower = 0, median = 0, upper = 0;  ///< lower and upper are NaN with too few measurements
  std::size_t count = 0;

  [[nodiscard]] bool known() const;
  /// Returns true if both ends are within 5 % of the median.
  [[nodiscard]] bool narrow() const;
  /// Converts to another unit.
  [[nodiscard]] MedianInterval times(double factor) const {
    return {factor * lower, factor * median, factor * upper, count};
  }
};

/// Smallest number of measurements with an interval: the range of five holds the median in only 94 of 100 cases.
inline constexpr std::size_t fewest_for_interval = 6;

/// Returns the rank l of the order statistic that begins the interval; the l-th from above ends it. The interval holds
/// the median with a probability of at least 0.95, for any distribution. Each of n values is below the median with
/// probability ½, so the coverage is 1 − 2·P(B < l) with B binomial. Returns 0 for n below fewest_for_interval.
/// Sources: Hahn and Meeker, "Statistical Intervals", 1991, section 5.2.1; Hoefler and Belli, "Scientific Benchmarking
/// of Parallel Computing Systems", 2015, section 3.1.3.
std::size_t first_order_statistic(std::size_t n);

/// @param values at least one
MedianInterval median_interval(std::vector<double> values);

/// Number of timed runs; absent: until each case's interval is narrow, at most most_runs.
using RunCount = std::optional<int>;
inline constexpr int most_runs = 30;

inline int runs_at_most(RunCount runs) { return runs.value_or(most_runs); }

/// Returns true if the measurements suffice.
bool is_enough(const std::vector<double>& values, RunCount runs);

/// Note for the interval columns of tables.
inline constexpr const char* interval_note =
    "From, to: where the median is with 95 % confidence, by order statistics; – where the runs are too few to say.";

/// Returns " --runs 5" for a command line; empty if the data decide.
std::string runs_option(RunCount runs);

/// Returns "the median of 5 runs", and the meaning of its interval.
std::string describe_runs(RunCount runs);

}  // namespace drape
