#pragma once

#include "codecs/codecs.hpp"

namespace drape {

/// Implements Codecs::begin_animation for APNG with FFmpeg's libraries: OpenCV cannot write APNG with them.
AnimationPen begin_apng(const std::string& file, double fps, cv::Size size);

}  // namespace drape
