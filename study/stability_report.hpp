#pragma once

#include <filesystem>
#include <string>

#include "study/result_table.hpp"
#include "study/stability.hpp"

namespace drape {

/// Where semi-implicit Euler becomes unstable, measured and predicted.
ResultTable border_table(const StabilityStudy& study);

/// The study for a terminal, and as a page.
std::string stability_text(const StabilityStudy& study);
std::string stability_page(const StabilityStudy& study);

/// Writes report.html, border.csv, and the files of every map into a folder.
/// @returns what could not be done, as a sentence; empty if all is there
/// @throws OutputError
std::string write_stability_files(const StabilityStudy& study, const std::filesystem::path& folder);

}  // namespace drape
