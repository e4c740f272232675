#pragma once

#include <filesystem>
#include <vector>

namespace drape {

/// Returns true if a file name denotes a sequence: it contains {frame} or {frame:04}.
bool names_frames(const std::filesystem::path& file);

/// Returns true if a file belongs to such a sequence.
bool is_frame(const std::filesystem::path& file, const std::filesystem::path& named);

/// Returns the files of a sequence like "body/{frame:04}.obj", by number. Numbers are consecutive from any first one.
/// 04 pads shorter numbers with zeros to 4 digits.
/// @throws UsageError if there are none, or if one is missing in between
std::vector<std::filesystem::path> frame_files(const std::filesystem::path& file);

}  // namespace drape
