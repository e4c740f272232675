#pragma once

#include <filesystem>

#include "sweep/results.hpp"

namespace drape {

/// The name of the page's file.
inline constexpr const char* sweep_page_name = "report.html";

/// Writes what a sweep has to say into its folder: runs.csv, report.md, table.tex and the page.
/// @throws OutputError
void write_sweep_report(const SweepResults& results, const std::filesystem::path& folder);

}  // namespace drape
