#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/validation.hpp"

namespace drape {

/// File name of all measurements of a validation study.
inline constexpr const char* validation_runs_name = "runs.csv";

/// File name of the measurements of a shard.
inline constexpr const char* validation_shard_name = "validation-runs.csv";

/// Returns all measurements so far as a file of runs, see RunsWriter.
std::string validation_runs(const ValidationStudy& study);

/// Copies the measurements of a file into a planned study.
/// @param study planned with the same command as the file
/// @throws UsageError if the file is damaged or belongs to another study
void read_validation_runs(const std::filesystem::path& file, ValidationStudy& study);

/// Returns the study in a file, with the runs that it has.
/// @throws UsageError likewise
ValidationStudy validation_study(const std::filesystem::path& file);

/// A study merged from shards.
struct MergedValidation {
  ValidationStudy study;
  std::vector<Shard> missing;  ///< shards without measurements
};

/// Reads and merges the measurements of shards.
/// @param files at least one
/// @throws UsageError if a file is damaged, or they belong to different studies
MergedValidation merge_validation(const std::vector<std::filesystem::path>& files);

}  // namespace drape
