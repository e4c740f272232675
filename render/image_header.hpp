#pragma once

#include <optional>
#include <span>

namespace drape {

struct ImageSize {
  int width = 0, height = 0;  ///< [pixels]
};

/// The size that the beginning of a PNG or JPEG file says its picture has, so that one that is too large is known
/// before memory is taken for it; nothing for other formats and damaged files.
std::optional<ImageSize> size_in_header(std::span<const unsigned char> bytes);

}  // namespace drape
