#pragma once

#include <filesystem>
#include <string>

#include "study/accuracy_report.hpp"

namespace drape {

/// The name of the file of a study's runs, in the folder of its results.
inline constexpr const char* runs_name = "runs.csv";

/// Everything that a study measured, as RunsWriter writes it: what read_runs() makes a study of, from which the same
/// report follows. docs/study-data.md says what is in it.
std::string runs_csv(const AccuracyStudy& study);

/// @param folder of the results, with the animations
/// @throws UsageError "file:line: message" if the file is missing, cut, or another
AccuracyStudy read_runs(const std::filesystem::path& folder);

}  // namespace drape
