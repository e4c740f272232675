#pragma once

#include <optional>
#include <span>

namespace drape {

struct ImageSize {
  int width = 0, height = 0;  ///< [pixels]
};

/// Reads the picture size from the beginning of a PNG or JPEG file, so that a huge picture is refused before memory is
/// allocated. Returns nothing for other formats and damaged files.
std::optional<ImageSize> size_in_header(std::span<const unsigned char> bytes);

}  // namespace drape
