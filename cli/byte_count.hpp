#pragma once

#include <cstdint>
#include <string>

namespace drape {

/// "5MB", "800 kB", "1.5GiB" or "5000" as bytes: k, M and G are thousands, with an i they are 1024.
/// @param option that it is given to, for the message
/// @throws UsageError if it is anything else, or less than one byte
std::uint64_t parse_byte_count(const std::string& option, const std::string& text);

}  // namespace drape
