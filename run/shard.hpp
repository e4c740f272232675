#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
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

/// Returns the folder of a shard in the folder of the whole: "shard-2-of-5"; the folder itself for the whole.
std::filesystem::path shard_place(const std::filesystem::path& folder, const Shard& shard);

/// Returns the folders with parts of a whole: the shards in a folder, or the folder itself. Empty if there is neither.
/// @param mark the file that identifies a part
/// @throws UsageError if the folder cannot be read
std::vector<std::filesystem::path> parts_in(const std::filesystem::path& folder, const char* mark);

/// The shards that were found while they are merged.
class FoundShards {
 public:
  /// @param whole noun of the whole for messages: "study"
  explicit FoundShards(std::string whole) : whole_(std::move(whole)) {}

  /// Adds the shard of a file.
  /// @returns false if there is one with its number already
  /// @throws UsageError if the whole has another number of shards
  bool add(const Shard& shard, const std::filesystem::path& file);

  /// Reports that a file belongs to another whole than the shards added so far, at least one.
  /// @throws UsageError
  [[noreturn]] void fail_as_other(const std::filesystem::path& file) const;

  [[nodiscard]] bool empty() const { return files_.empty(); }
  /// Returns the missing shards.
  [[nodiscard]] std::vector<Shard> missing() const;

 private:
  std::string whole_;
  std::size_t count_ = 0;
  std::map<std::size_t, std::filesystem::path> files_;  // by the shards' numbers
};

}  // namespace drape
