#pragma once

#include "render/image.hpp"

namespace drape {

/// A picture made smaller: each pixel the mean of what it covers, in linear light.
/// @param width, height at most the image's
Image scaled_image(const Image& image, int width, int height);

}  // namespace drape
