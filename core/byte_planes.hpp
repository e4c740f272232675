#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// Words as bytes: those of most significance of all words first, then the next ones. What is alike stands together, so
/// that it packs well.
std::string byte_planes(const std::vector<std::uint64_t>& words);

/// The inverse. What is left over of eight equal planes is not read.
std::vector<std::uint64_t> from_byte_planes(std::string_view bytes);

}  // namespace drape
