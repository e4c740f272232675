#pragma once

#include "codecs/codecs.hpp"

namespace drape {

/// Codecs::begin_animation, by FFmpeg's libraries themselves: OpenCV asks them for no animation.
AnimationPen begin_animation(const std::string& file, const std::string& form, double fps, cv::Size size);

}  // namespace drape
