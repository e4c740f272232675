#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// Splits words into byte planes: the most significant bytes of all words, then the next ones. Similar bytes become
/// neighbours, so the result compresses well.
std::string byte_planes(const std::vector<std::uint64_t>& words);

/// Inverts byte_planes(). Ignores a remainder of size() modulo 8.
std::vector<std::uint64_t> from_byte_planes(std::string_view bytes);

}  // namespace drape
