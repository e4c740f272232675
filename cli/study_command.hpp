#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "cli/command_line.hpp"
#include "reports/diagram.hpp"
#include "run/progress.hpp"
#include "study/report.hpp"

namespace drape {

/// Help of --runs.
inline constexpr const char* runs_help =
    "Timed runs of every case; default: until the median is known to 5 %, at least 6 and at most 30";

/// Place and form of a study's results.
struct StudyFiles {
  std::string folder;
  FigureStyle style = FigureStyle::screen;
};

/// Adds -o and --style. The folder's present value is the default.
void add_study_files(CLI::App& subcommand, StudyFiles& files);

/// Runs measurements with a progress display, then writes and prints the report.
/// @param measure returns the report; nothing if it was stopped
/// @throws errors of measure
/// @throws OutputError
ExitCode run_study(const StudyFiles& files, const CommonOptions& common,
                   const std::function<std::optional<StudyReport>(const std::stop_token&, Progress&)>& measure);

/// Writes a report's files and prints it.
/// @throws OutputError
ExitCode conclude_study(const StudyReport& report, const StudyFiles& files, const CommonOptions& common);

/// Merges the shards of a stability study in these folders into a report.
/// @throws UsageError if they are from different studies
ExitCode merge_stability_study(const std::vector<std::filesystem::path>& parts, const StudyFiles& to,
                               const CommonOptions& common);

/// Merges the shards of a validation study into a report; also writes its runs.
ExitCode merge_validation_study(const std::vector<std::filesystem::path>& parts, const StudyFiles& to,
                                const CommonOptions& common);

/// Returns a study's report with the command as it was typed, unless it was stopped.
template <class Study>
std::optional<StudyReport> report_of(const std::optional<Study>& study, StudyReport (*report)(const Study&),
                                     const CommonOptions& common) {
  if (!study) return std::nullopt;
  StudyReport made = report(*study);
  made.command = common.command;
  return made;
}

/// Each adds a subcommand of study.
void add_accuracy_study(CLI::App& study, const CommonOptions& common, Command& command);
void add_scaling_study(CLI::App& study, const CommonOptions& common, Command& command);
void add_stability_study(CLI::App& study, const CommonOptions& common, Command& command);
void add_validation_study(CLI::App& study, const CommonOptions& common, Command& command);

}  // namespace drape
