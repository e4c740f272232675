#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// Returns the name and version of libpng, which handles PNG files without the codecs module.
std::string png_library();

/// Encodes pixels (blue, green, red) as a PNG file. Equal pixels give equal bytes.
/// @throws std::runtime_error with the reason if it cannot be encoded
std::vector<std::uint8_t> png_from_bgr(const cv::Mat& bgr);

/// Returns true if the first eight bytes are those of a PNG file.
bool is_png(std::string_view bytes);

/// Decodes a PNG file of any kind to 8-bit blue, green, red; ignores transparency and colour profiles. Prints nothing.
/// @returns an empty picture if the file is damaged, or has more than 2³⁰ pixels
cv::Mat bgr_from_png(std::string_view bytes);

}  // namespace drape
