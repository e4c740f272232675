#pragma once

#include <filesystem>
#include <string>

#include "sweep/results.hpp"

namespace drape {

/// File name of the page.
inline constexpr const char* sweep_page_name = "report.html";

/// Writes a sweep's reports into its folder: runs.csv, report.md, table.tex, the page, and every diagram as CSV, SVG,
/// PDF and PNG.
/// @returns the first problem as a sentence; empty if everything was written
/// @throws OutputError
std::string write_sweep_report(const SweepResults& results, const std::filesystem::path& folder);

}  // namespace drape
