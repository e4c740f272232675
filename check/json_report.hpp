#pragma once

#include <string>

#include "check/report.hpp"

namespace drape {

/// Returns the report as JSON: everything except the pictures, which are files beside it, see frame_file().
std::string json_report(const CheckReport& report);

/// Writes the pictures of all frames that are not exact as PNG files below a folder, named by frame_file().
/// @throws OutputError
void write_frame_files(const CheckReport& report, const std::filesystem::path& folder);

}  // namespace drape
