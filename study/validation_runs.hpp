#pragma once

#include <filesystem>
#include <string>

#include "study/validation.hpp"

namespace drape {

/// The name of the file that holds all that a study of validation has measured.
inline constexpr const char* validation_runs_name = "runs.csv";

/// Everything measured so far, as a file of runs; see RunsWriter.
std::string validation_runs(const ValidationStudy& study);

/// Puts what files of one study have measured into a plan.
/// @param study planned; its command must be that of the files
/// @throws UsageError if a file is damaged or belongs to another study
void read_validation_runs(const std::filesystem::path& file, ValidationStudy& study);

/// The study that a file holds, with the runs that it has.
/// @throws UsageError likewise
ValidationStudy validation_study(const std::filesystem::path& file);

}  // namespace drape
