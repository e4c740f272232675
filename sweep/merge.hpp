#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sweep/results.hpp"

namespace drape {

/// Where a shard's runs go within the folder of the whole: "shard-2-of-5".
std::filesystem::path shard_place(const std::filesystem::path& folder, const Shard& shard);

/// The folders with parts of a sweep: the shards within each of those given, or itself where it has none.
/// @throws UsageError if one has none
std::vector<std::filesystem::path> sweep_parts(const std::vector<std::string>& folders);

/// Puts the runs of parts together in one folder, as if one process had run them all; of runs that several have, one
/// that is settled wins. Files are linked where the file system can, and copied where not.
/// @returns the whole sweep
/// @throws UsageError  if the parts are not of one sweep
/// @throws OutputError
SweepFile merge_sweeps(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& folder);

}  // namespace drape
