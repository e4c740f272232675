#pragma once

#include <filesystem>
#include <string>

#include "study/accuracy_report.hpp"

namespace drape {

/// Name of the file with a study's measurements, in its results folder.
inline constexpr const char* runs_name = "runs.csv";

/// Returns all measurements of a study, as RunsWriter writes them. read_runs() restores the study, which gives the same
/// report. The format is described in docs/study-data.md.
std::string runs_csv(const AccuracyStudy& study);

/// Reads a study from the folder of its results, with the animations.
/// @throws UsageError "file:line: message" if the file is missing, truncated or of another kind
AccuracyStudy read_runs(const std::filesystem::path& folder);

}  // namespace drape
