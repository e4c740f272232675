#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "sweep/results.hpp"

namespace drape {

/// The file that marks the folder of a sweep and of its shards, see parts_in().
inline constexpr const char* sweep_mark = "sweep.json";

/// Merges the runs of several parts into one folder, as if one process had run them all. If several parts have a run, a
/// settled one wins. Files are hard links if the file system supports them, otherwise copies.
/// @param stop checked between runs; the remaining runs are then skipped
/// @returns the whole sweep
/// @throws UsageError  if the parts belong to different sweeps
/// @throws OutputError
SweepFile merge_sweeps(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& folder,
                       const std::stop_token& stop = {});

}  // namespace drape
