#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace drape {

/// Encodes bytes as base64 (RFC 4648, section 4).
std::string base64(std::string_view bytes);

/// Decodes base64 that may contain white space. Several encoded parts, each ended by its padding, may follow each
/// other.
/// @returns nothing if there is another character
std::optional<std::string> from_base64(std::string_view text);

}  // namespace drape
