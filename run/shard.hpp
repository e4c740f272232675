#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace drape {

/// One of `count` parts of a set of runs; numbers begin at 1.
struct Shard {
  std::size_t number = 1, count = 1;

  [[nodiscard]] bool whole() const { return count == 1; }
  /// Returns "2/5".
  [[nodiscard]] std::string text() const;
};

/// Reads "2/5". @throws UsageError
Shard parse_shard(const std::string& text);

/// Returns the runs of a shard, ascending. Greedy assignment balances the costs: the costliest run first, each to the
/// shard with the least load. Depends on the costs alone.
std::vector<std::size_t> runs_of_shard(const std::vector<double>& costs, const Shard& shard);

}  // namespace drape
