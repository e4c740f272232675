#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// libpng with its version: what makes and reads PNG files, without the module of the other codecs.
std::string png_library();

/// The bytes of a PNG file with these pixels: blue, green, red. The same pixels give the same bytes.
/// @throws std::runtime_error why it cannot be encoded
std::vector<std::uint8_t> png_from_bgr(const cv::Mat& bgr);

/// Returns whether these are the bytes of a PNG file, by their first eight.
bool is_png(std::string_view bytes);

/// The pixels of a PNG file, of any kind, as blue, green, red of 8 bits; transparency and colour profiles are ignored.
/// Says nothing on the terminal.
/// @returns a picture without pixels if the file is damaged, or has more than 2³⁰ of them
cv::Mat bgr_from_png(std::string_view bytes);

}  // namespace drape
