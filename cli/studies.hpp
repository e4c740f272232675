#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "cli/command_line.hpp"
#include "run/progress.hpp"
#include "study/report.hpp"

namespace drape {

/// Of --runs.
inline constexpr const char* runs_help =
    "Timed runs of every case; default: until the median is known to 5 %, at least 6 and at most 30";

/// Measures while it shows the progress, and then writes the report's files and prints it.
/// @param measure the study's report; nothing if it was stopped
/// @throws what measure throws
/// @throws OutputError
ExitCode run_study(const std::filesystem::path& folder, const CommonOptions& common,
                   const std::function<std::optional<StudyReport>(const std::stop_token&, Progress&)>& measure);

/// Writes a report's files and prints it.
/// @throws OutputError
ExitCode conclude_study(const StudyReport& report, const std::filesystem::path& folder, const CommonOptions& common);

/// The report of a study of stability whose shards are in these folders.
/// @throws UsageError if they are not of one study
ExitCode merge_stability_study(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& folder,
                               const CommonOptions& common);

/// The same of a study of validation, whose runs it also writes there.
ExitCode merge_validation_study(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& folder,
                                const CommonOptions& common);

/// A study's report, if it was not stopped.
template <class Study>
std::optional<StudyReport> report_of(const std::optional<Study>& study, StudyReport (*report)(const Study&)) {
  return study ? std::optional(report(*study)) : std::nullopt;
}

/// Each adds a subcommand of study.
void add_accuracy_study(CLI::App& study, const CommonOptions& common, Command& command);
void add_scaling_study(CLI::App& study, const CommonOptions& common, Command& command);
void add_stability_study(CLI::App& study, const CommonOptions& common, Command& command);
void add_validation_study(CLI::App& study, const CommonOptions& common, Command& command);

}  // namespace drape
