#pragma once

#include <filesystem>
#include <vector>

namespace drape {

/// Whether a file's name stands for many: it has {frame} or {frame:04} in it.
bool names_frames(const std::filesystem::path& file);

/// Whether a file is one that such a name stands for.
bool is_frame(const std::filesystem::path& file, const std::filesystem::path& named);

/// The files of a name like "body/{frame:04}.obj", by their numbers, which follow each other from any first one on;
/// 04 says that smaller numbers have zeros before them up to 4 digits.
/// @throws UsageError if there are none, or if one is missing in between
std::vector<std::filesystem::path> frame_files(const std::filesystem::path& file);

}  // namespace drape
