#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string_view>

#include "codecs/codecs.hpp"
#include "tests/support/files.hpp"

namespace drape::test {

/// The colours in the bytes of a picture, blue, green, red; none if they are damaged. Here OpenCV is loaded when a test
/// first asks: whoever links its decoders takes ten times as long to start, and every test is a process.
inline cv::Mat decoded_picture(std::string_view bytes) {
  constexpr int colours = 1;  // cv::IMREAD_COLOR
  return decode_picture(bytes, colours);
}

/// The colours of a picture's file, blue, green, red; none if it cannot be read.
inline cv::Mat read_picture(const std::filesystem::path& file) { return decoded_picture(content(file)); }

}  // namespace drape::test
