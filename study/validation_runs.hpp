#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/validation.hpp"

namespace drape {

/// The name of the file that holds all that a study of validation has measured.
inline constexpr const char* validation_runs_name = "runs.csv";

/// The name of the file in which a shard keeps what it has measured.
inline constexpr const char* validation_shard_name = "validation-runs.csv";

/// Everything measured so far, as a file of runs; see RunsWriter.
std::string validation_runs(const ValidationStudy& study);

/// Puts what files of one study have measured into a plan.
/// @param study planned; its command must be that of the files
/// @throws UsageError if a file is damaged or belongs to another study
void read_validation_runs(const std::filesystem::path& file, ValidationStudy& study);

/// The study that a file holds, with the runs that it has.
/// @throws UsageError likewise
ValidationStudy validation_study(const std::filesystem::path& file);

/// Shards of a study put together.
struct MergedValidation {
  ValidationStudy study;
  std::vector<Shard> missing;  ///< whose runs are not measured
};

/// Reads what shards have measured.
/// @param files at least one
/// @throws UsageError if one is damaged, or they are not of one study
MergedValidation merge_validation(const std::vector<std::filesystem::path>& files);

}  // namespace drape
