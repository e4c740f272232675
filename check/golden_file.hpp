#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace drape {

/// Reads a golden's file.
/// @param most size limit of such a file [bytes]
/// @throws UsageError naming the file if it is missing, irregular, too large or unreadable
std::string read_golden_file(const std::filesystem::path& file, std::uintmax_t most);

/// Throws an error with the file, its problem and a remedy. @throws UsageError
[[noreturn]] void fail_to_read(const std::filesystem::path& file, const std::string& problem);

}  // namespace drape
