#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

#include "check/flip.hpp"
#include "check/report.hpp"
#include "render/image.hpp"
#include "scene/check_settings.hpp"

namespace drape {

/// How two pictures differ, and where.
struct PictureComparison {
  PictureDifference difference;
  ErrorMap flip;  ///< empty if the pictures are the same
};

/// Compares two pictures of the same size.
/// @param ignored where they count as the same
/// @throws std::invalid_argument if they have different sizes
PictureComparison compare_pictures(const Image& expected, const Image& actual, const PictureLimits& limits,
                                   const std::vector<PixelRectangle>& ignored = {});

/// How much of a picture rectangles cover, 0 to 1.
double covered_part(const std::vector<PixelRectangle>& rectangles, const Eigen::Vector2i& size);

/// The absolute difference of each channel times a factor, at most 255.
Image amplified_difference(const Image& expected, const Image& actual, double factor);

/// The factor that makes the largest difference white; 1 if there is none.
double amplification(const PictureDifference& difference);

/// The picture in the bytes of a PNG file, without transparency.
/// @param size that it has to have [pixels]: nothing larger is unpacked
/// @throws std::invalid_argument saying what is wrong with the bytes
Image decode_png(std::string_view bytes, const Eigen::Vector2i& size);

/// How many bytes a PNG file of that size has at most.
std::uintmax_t most_png_bytes(const Eigen::Vector2i& size);

}  // namespace drape
