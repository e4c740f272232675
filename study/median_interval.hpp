#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace drape {

/// The median of some measurements, and where the median of all that could be made is: in 95 of 100 such intervals.
struct MedianInterval {
  double lower = 0, median = 0, upper = 0;  ///< lower and upper are not numbers where there are too few measurements
  std::size_t count = 0;

  [[nodiscard]] bool known() const;
  /// Whether both ends are within 5 % of the median.
  [[nodiscard]] bool narrow() const;
  /// In another unit.
  [[nodiscard]] MedianInterval times(double factor) const {
    return {factor * lower, factor * median, factor * upper, count};
  }
};

/// How many measurements an interval takes: of five, the least and the largest hold the median between them in 94 of
/// 100 cases only.
inline constexpr std::size_t fewest_for_interval = 6;

/// The number l of the order statistic, from 1, with which an interval begins that ends with the l-th from above and
/// holds the median with a probability of 0.95 at least, whatever the distribution: one less of n than the median
/// is each with probability ½, so that is 1 − 2·P(B < l) with B binomial (Hahn and Meeker, "Statistical
/// Intervals", 1991, section 5.2.1; Hoefler and Belli, "Scientific Benchmarking of Parallel Computing Systems", 2015,
/// section 3.1.3). 0: there is none, as n is below fewest_for_interval.
std::size_t first_order_statistic(std::size_t n);

/// @param values at least one
MedianInterval median_interval(std::vector<double> values);

/// How often something is timed: so many times, or else until each case's interval is narrow, but no more than
/// most_runs times.
using RunCount = std::optional<int>;
inline constexpr int most_runs = 30;

inline int runs_at_most(RunCount runs) { return runs.value_or(most_runs); }

/// Whether what was measured so far says enough.
bool is_enough(const std::vector<double>& values, RunCount runs);

/// Of the columns that tables have for it.
inline constexpr const char* interval_note =
    "From, to: where the median is with 95 % confidence, by order statistics; – where the runs are too few to say.";

/// " --runs 5" of a command line; empty where the data decide.
std::string runs_option(RunCount runs);

/// "the median of 5 runs", and what its interval is.
std::string describe_runs(RunCount runs);

}  // namespace drape
