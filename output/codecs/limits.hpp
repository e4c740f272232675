#pragma once

#include <cstdint>

namespace drape {

/// Most pixels of a picture that is decoded. A file that claims more is taken for damaged.
constexpr std::uint64_t most_decoded_pixels = std::uint64_t{1} << 30;

}  // namespace drape
