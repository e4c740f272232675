#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

#include "check/report.hpp"
#include "drape/render/image.hpp"
#include "drape/scene/scene.hpp"
#include "render/flip.hpp"

namespace drape {

/// The differences of two pictures, with a map.
struct PictureComparison {
  PictureDifference difference;
  ErrorMap flip;  ///< empty if the pictures are equal
};

/// Compares two pictures of the same size.
/// @param ignored areas that count as equal
/// @throws std::invalid_argument if the sizes differ
PictureComparison compare_pictures(const Image& expected, const Image& actual, const PictureLimits& limits,
                                   const std::vector<PixelRectangle>& ignored = {});

/// Returns the share of a picture covered by rectangles, 0 to 1.
double covered_part(const std::vector<PixelRectangle>& rectangles, const Eigen::Vector2i& size);

/// Returns the absolute difference of each channel times a factor, at most 255.
Image amplified_difference(const Image& expected, const Image& actual, double factor);

/// Returns the sum of all absolute differences of channels of two pictures of the same size.
std::int64_t summed_difference(const Image& a, const Image& b);

/// Returns the factor that makes the largest difference white; 1 if there is none.
double amplification(const PictureDifference& difference);

/// Decodes a PNG file without transparency.
/// @param size expected size [pixels]; larger pictures are rejected before decompression
/// @throws std::invalid_argument if the bytes are invalid
Image decode_png(std::string_view bytes, const Eigen::Vector2i& size);

/// Returns the largest size of a PNG file of this picture size [bytes].
std::uintmax_t most_png_bytes(const Eigen::Vector2i& size);

}  // namespace drape
