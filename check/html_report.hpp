#pragma once

#include <filesystem>
#include <string>

#include "check/report.hpp"

namespace drape {

/// The report as one self-contained HTML page: verdicts on top, failed scenes first, each with its pictures compared,
/// its curves, and the commands that rerun and bless it.
std::string html_report(const CheckReport& report);

/// Writes html_report() to a file. @throws OutputError if it cannot be written
void write_html_report(const CheckReport& report, const std::filesystem::path& file);

}  // namespace drape
