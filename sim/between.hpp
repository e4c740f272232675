#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace drape {

/// Between which two of some samples a time is.
struct Between {
  std::size_t before, after;  ///< the same at a sample and beyond the first and the last
  double share;               ///< of the way from one to the other: 0 to 1, exactly 0 where they are the same
};

/// @param times of the samples: at least one, increasing
inline Between between(const std::vector<double>& times, double time) {
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
  if (next == 0) return {0, 0, 0};
  if (next == times.size() || time == times[next - 1]) return {next - 1, next - 1, 0};
  return {next - 1, next, (time - times[next - 1]) / (times[next] - times[next - 1])};
}

}  // namespace drape
