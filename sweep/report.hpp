#pragma once

#include <filesystem>
#include <string>

#include "sweep/results.hpp"

namespace drape {

/// The name of the page's file.
inline constexpr const char* sweep_page_name = "report.html";

/// Writes what a sweep has to say into its folder: runs.csv, report.md, table.tex, the page, and every diagram as CSV,
/// SVG, PDF and PNG.
/// @returns what could not be done, as a sentence; empty if all is there
/// @throws OutputError
std::string write_sweep_report(const SweepResults& results, const std::filesystem::path& folder);

}  // namespace drape
