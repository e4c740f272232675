#pragma once

#include <string>

#include "core/keys.hpp"
#include "render/image.hpp"

namespace drape {

/// Writes a line into a picture: ASCII and µ, in a font of strokes that needs no file.
/// @param left, base where the first letter stands [pixels]
/// @param height     of a capital letter [pixels]
void draw_text(Image& image, int left, int base, const std::string& text, double height, const Rgb& color);

/// How wide a line is [pixels].
int text_width(const std::string& text, double height);

/// The colours of "viridis", from dark blue (0) to yellow (1): as bright as they are far along for every eye.
Rgb viridis(double value);

}  // namespace drape
