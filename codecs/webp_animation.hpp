#pragma once

#include "codecs/codecs.hpp"

namespace drape {

/// Codecs::begin_animation of a WebP.
///
/// Each frame changes what has moved, by lossy compression, where the viewer's picture is off. A pixel that is the same
/// for five frames is right to two of 255: what is still off then is compressed again, and without loss where that
/// does not help. libwebp's own WebPAnimEncoder compares frames as they were drawn, not as they are seen, and leaves
/// changes that are too small to see each time: a shadow that passes leaves bars.
AnimationPen begin_webp(const std::string& file, double fps, cv::Size size);

}  // namespace drape
