#pragma once

#include <filesystem>

#include "cli/command_line.hpp"
#include "sweep/results.hpp"

namespace drape {

/// Writes the report of a sweep and prints a summary.
/// @returns the exit code of the worst run
ExitCode conclude_sweep(const SweepResults& results, const std::filesystem::path& folder, const CommonOptions& common);

}  // namespace drape
