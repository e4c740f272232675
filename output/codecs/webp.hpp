#pragma once

#include <opencv2/core/types.hpp>
#include <string>

#include "output/codecs/codecs.hpp"

namespace drape {

/// Implements Codecs::begin_animation for WebP.
///
/// Each frame rewrites, with lossy compression, the moved pixels that are wrong in the viewer's picture. Pixels that
/// rest for five frames must be within 2 of 255: wrong ones are compressed again, and losslessly if that fails.
/// libwebp's WebPAnimEncoder compares frames as drawn, not as seen, so small changes accumulate: a passing shadow
/// leaves bars.
AnimationPen begin_webp(const std::string& file, double fps, cv::Size size);

}  // namespace drape
