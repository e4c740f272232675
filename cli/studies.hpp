#pragma once

#include <filesystem>

#include "cli/command_line.hpp"
#include "study/report.hpp"

namespace drape {

/// Writes a study's files, and prints it.
ExitCode hand_out(const StudyReport& report, const std::filesystem::path& folder, const CommonOptions& common);

/// Each adds a subcommand of study.
void add_accuracy_study(CLI::App& study, const CommonOptions& common, Command& command);
void add_scaling_study(CLI::App& study, const CommonOptions& common, Command& command);
void add_stability_study(CLI::App& study, const CommonOptions& common, Command& command);

}  // namespace drape
