#pragma once

#include <filesystem>
#include <string>

namespace drape {

/// Follows a chain of symbolic links to its end and returns that absolute path, which need not exist.
/// @throws std::filesystem::filesystem_error if the chain has no end or cannot be followed
std::filesystem::path link_target(const std::filesystem::path& file);

/// Returns a key that is the same for all paths to one file, through ".", "..", symbolic links or hard links. The file
/// need not exist. Two missing files whose names differ only in the case of letters count as different.
std::string file_identity(const std::filesystem::path& file);

}  // namespace drape
