#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace drape {

/// The bytes of a golden's file.
/// @param most what such a file can have at most [bytes]
/// @throws UsageError naming the file if it is missing, is no regular file, is larger or cannot be read
std::string read_golden_file(const std::filesystem::path& file, std::uintmax_t most);

/// Ends the reading of a golden's file, saying what is wrong with it and what to do. @throws UsageError
[[noreturn]] void fail_to_read(const std::filesystem::path& file, const std::string& problem);

}  // namespace drape
