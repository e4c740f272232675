#pragma once

#include <opencv2/core/mat.hpp>
#include <string_view>

namespace drape {

/// Returns true if the first three bytes are those of a JPEG file.
bool is_jpeg(std::string_view bytes);

/// Decodes a JPEG file of any kind to 8-bit blue, green, red; ignores colour profiles. Prints nothing.
/// @param turns true to turn the picture upright, as its Exif orientation says
/// @returns an empty picture if the file is damaged, or has more than 2³⁰ pixels
cv::Mat bgr_from_jpeg(std::string_view bytes, bool turns);

}  // namespace drape
