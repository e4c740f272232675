#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace drape {

/// A part of many runs: the one of this number, from 1, of so many.
struct Shard {
  std::size_t number = 1, count = 1;

  [[nodiscard]] bool whole() const { return count == 1; }
  /// "2/5"
  [[nodiscard]] std::string text() const;
};

/// Reads "2/5". @throws UsageError
Shard parse_shard(const std::string& text);

/// Which of the runs are in a shard, ascending. They are shared out so that every shard takes about as long: the
/// costliest first, each to the shard that has least. Depends on the costs alone.
std::vector<std::size_t> runs_of_shard(const std::vector<double>& costs, const Shard& shard);

}  // namespace drape
