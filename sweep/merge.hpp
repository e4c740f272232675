#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "sweep/results.hpp"

namespace drape {

/// Returns the folder of a shard's runs in the folder of the whole: "shard-2-of-5".
std::filesystem::path shard_place(const std::filesystem::path& folder, const Shard& shard);

/// Files that mark the folder of a shard, of a sweep and of a check.
inline constexpr const char *sweep_mark = "sweep.json", *check_mark = "check.cbor";

/// Returns the folders with parts of a sweep, check or study: the shards in a folder, or the folder itself. Empty if
/// there is neither.
/// @param mark the file that identifies a part
/// @throws UsageError if the folder cannot be read
std::vector<std::filesystem::path> parts_in(const std::filesystem::path& folder, const char* mark);

/// Merges the runs of several parts into one folder, as if one process had run them all. If several parts have a run, a
/// settled one wins. Files are hard links if the file system supports them, otherwise copies.
/// @param stop checked between runs; the remaining runs are then skipped
/// @returns the whole sweep
/// @throws UsageError  if the parts belong to different sweeps
/// @throws OutputError
SweepFile merge_sweeps(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& folder,
                       const std::stop_token& stop = {});

}  // namespace drape
