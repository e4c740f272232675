#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace drape {

/// Position of a time between two samples.
struct Between {
  std::size_t before, after;  ///< indices of the two samples; equal at a sample, before the first and after the last
  double share;               ///< fraction of the way from one to the other, 0 to 1; exactly 0 if they are equal
};

/// Returns the position of a time between samples.
/// @param times of the samples: at least one, ascending
inline Between between(const std::vector<double>& times, double time) {
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
  if (next == 0) return {0, 0, 0};
  if (next == times.size() || time == times[next - 1]) return {next - 1, next - 1, 0};
  return {next - 1, next, (time - times[next - 1]) / (times[next] - times[next - 1])};
}

}  // namespace drape
