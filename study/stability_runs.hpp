#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "run/shard.hpp"
#include "study/stability.hpp"

namespace drape {

/// The file in which a shard of a study of stability keeps what it has measured.
inline constexpr const char* stability_runs_name = "stability-runs.csv";

/// Which parts of a study are in a shard, ascending.
std::vector<std::size_t> parts_of_shard(const StabilityStudy& study, const Shard& shard);

/// What was measured of a study, as RunsWriter has it.
/// @param shard that was measured
std::string stability_runs(const StabilityStudy& study, const Shard& shard);

/// Shards of a study put together.
struct MergedStability {
  StabilityStudy study;
  std::vector<Shard> missing;  ///< whose parts of it are not measured
};

/// Reads what shards have measured.
/// @param files at least one
/// @throws UsageError if one of them is damaged, or they are not of one study made by this program
MergedStability merge_stability(const std::vector<std::filesystem::path>& files);

}  // namespace drape
