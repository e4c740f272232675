#pragma once

#include <string>

#include "check/report.hpp"

namespace drape {

/// Returns the report as JSON: everything except the pictures, which are files beside it, see frame_file().
std::string json_report(const CheckReport& report);

/// Writes the pictures of all frames that are not exact as PNG files below a folder, named by frame_file().
/// @throws OutputError
void write_frame_files(const CheckReport& report, const std::filesystem::path& folder);

/// Returns JUnit XML for continuous-integration servers. Each scene has a test case for its motion and one for its
/// pictures, and two more if it was checked end to end.
std::string junit_report(const CheckReport& report);

/// Returns a check's results as Markdown for a GitHub job summary: a table of the scenes, failed ones first.
std::string github_summary(const CheckReport& report);

/// Returns a line for each failed scene, which GitHub shows beside the scene's file.
std::string github_annotations(const CheckReport& report);

}  // namespace drape
