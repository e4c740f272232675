#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace drape {

/// The bytes of a file. Besides plain files a pipe is read, up to the limit; devices, which may never end, are not.
/// @param limit the most bytes that it may have
/// @throws UsageError "file: message" if it is not there, a folder or device, longer, or cannot be read
std::string read_file(const std::filesystem::path& file, std::size_t limit);

/// The same for a text in UTF-8, without the byte-order mark that some editors put before it.
/// @throws UsageError also for UTF-16, which such a mark tells, and for what no text has, a zero byte
std::string read_text(const std::filesystem::path& file, std::size_t limit);

/// The same of bytes that have been read from it.
std::string text_of(const std::filesystem::path& file, std::string text);

}  // namespace drape
