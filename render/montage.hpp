#pragma once

#include <cstdint>
#include <vector>

#include "render/image.hpp"

namespace drape {

/// Arranges pictures of one size row after row, with a grey gap between them; unused places in the last row are grey.
/// @param pictures at least one
/// @param columns  pictures per row, at least 1
/// @param gap      between two pictures [pixels]
/// @throws std::invalid_argument if the pictures have different sizes
Image montage(const std::vector<const Image*>& pictures, int columns, int gap, std::uint8_t gray);

}  // namespace drape
