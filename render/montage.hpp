#pragma once

#include <cstdint>
#include <vector>

#include "render/image.hpp"

namespace drape {

/// Pictures of one size side by side, row after row, with a gap of one gray between them; places left over in the last
/// row are of that gray too.
/// @param pictures at least one
/// @param columns  in a row, at least 1
/// @param gap      between two pictures [pixels]
/// @throws std::invalid_argument if the pictures have different sizes
Image montage(const std::vector<const Image*>& pictures, int columns, int gap, std::uint8_t gray);

}  // namespace drape
