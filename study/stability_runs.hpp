#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "run/shard.hpp"
#include "study/stability.hpp"

namespace drape {

/// File name of the measurements of a shard of a stability study.
inline constexpr const char* stability_runs_name = "stability-runs.csv";

/// Returns the parts of a study in a shard, ascending.
std::vector<std::size_t> parts_of_shard(const StabilityStudy& study, const Shard& shard);

/// Returns the measurements of a study, as RunsWriter writes them.
/// @param shard that was measured
std::string stability_runs(const StabilityStudy& study, const Shard& shard);

/// A study merged from shards.
struct MergedStability {
  StabilityStudy study;
  std::vector<Shard> missing;  ///< shards without measurements
};

/// Reads and merges the measurements of shards.
/// @param files at least one
/// @throws UsageError if a file is damaged, or they belong to different studies or programs
MergedStability merge_stability(const std::vector<std::filesystem::path>& files);

}  // namespace drape
