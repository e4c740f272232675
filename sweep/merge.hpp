#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "sweep/results.hpp"

namespace drape {

/// Where a shard's runs go within the folder of the whole: "shard-2-of-5".
std::filesystem::path shard_place(const std::filesystem::path& folder, const Shard& shard);

/// What a shard leaves in its folder: sweep.json, or of a check check.cbor.
inline constexpr const char *sweep_mark = "sweep.json", *check_mark = "check.cbor";

/// The folders with parts of a sweep, check or study: the shards within a folder, or itself where it has none; perhaps
/// neither.
/// @param mark the file that tells which it is
/// @throws UsageError if the folder cannot be read
std::vector<std::filesystem::path> parts_in(const std::filesystem::path& folder, const char* mark);

/// Puts the runs of parts together in one folder, as if one process had run them all; of runs that several have, one
/// that is settled wins. Files are linked where the file system can, and copied where not.
/// @param stop asked between two runs: those that are left are not taken over then
/// @returns the whole sweep
/// @throws UsageError  if the parts are not of one sweep
/// @throws OutputError
SweepFile merge_sweeps(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& folder,
                       const std::stop_token& stop = {});

}  // namespace drape
