#pragma once

#include <cstdint>
#include <string>

namespace drape {

/// Parses "5MB", "800 kB", "1.5GiB" or "5000" as bytes: k, M, G are powers of 1000; ki, Mi, Gi of 1024.
/// @param option option name for messages
/// @throws UsageError if it is anything else, or less than one byte
std::uint64_t parse_byte_count(const std::string& option, const std::string& text);

}  // namespace drape
