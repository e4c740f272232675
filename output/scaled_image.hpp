#pragma once

#include "render/image.hpp"

namespace drape {

/// Shrinks a picture: each pixel is the mean of its area, in linear light.
/// @param width, height at most the image's
Image scaled_image(const Image& image, int width, int height);

}  // namespace drape
