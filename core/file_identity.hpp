#pragma once

#include <filesystem>
#include <string>

namespace drape {

/// The file that a chain of symbolic links ends at, which need not exist; absolute.
/// @throws std::filesystem::filesystem_error if the chain has no end or cannot be followed
std::filesystem::path link_target(const std::filesystem::path& file);

/// Two paths lead to one file if these are the same, however they are written: by ".", "..", symbolic links or several
/// names of the file. It need not exist. Two names that differ in nothing but the case of letters are taken for two
/// files as long as none of them exists.
std::string file_identity(const std::filesystem::path& file);

}  // namespace drape
