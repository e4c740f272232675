#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string_view>

#include "output/codecs/codecs.hpp"
#include "tests/support/files.hpp"

namespace drape::test {

/// Decodes a picture to blue, green, red; empty if it is damaged. OpenCV is loaded at first use: a program that links
/// its decoders starts ten times slower, and every test is a process.
inline cv::Mat decoded_picture(std::string_view bytes) {
  constexpr int colours = 1;  // cv::IMREAD_COLOR
  return decode_picture(bytes, colours);
}

/// Reads a picture file as blue, green, red; empty if it cannot be read.
inline cv::Mat read_picture(const std::filesystem::path& file) { return decoded_picture(content(file)); }

}  // namespace drape::test
