#pragma once

#include "codecs/codecs.hpp"

namespace drape {

/// Codecs::begin_animation of an APNG, by FFmpeg's libraries themselves: OpenCV asks them for no animation.
AnimationPen begin_apng(const std::string& file, double fps, cv::Size size);

}  // namespace drape
