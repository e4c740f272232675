#pragma once

#include <filesystem>
#include <string>

#include "check/report.hpp"

namespace drape {

/// Returns the report as one self-contained HTML page: verdicts on top, then the scenes, failed ones first. Each scene
/// has its compared pictures, curves, and the commands to rerun and bless it.
std::string html_report(const CheckReport& report);

/// Writes html_report() to a file. @throws OutputError if it cannot be written
void write_html_report(const CheckReport& report, const std::filesystem::path& file);

}  // namespace drape
