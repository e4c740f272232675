#pragma once

#include <filesystem>

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
/// @throws std::invalid_argument if they have different sizes
PictureComparison compare_pictures(const Image& expected, const Image& actual, const PictureLimits& limits);

/// The absolute difference of each channel times a factor, at most 255.
Image amplified_difference(const Image& expected, const Image& actual, double factor);

/// The factor that makes the largest difference white; 1 if there is none.
double amplification(const PictureDifference& difference);

/// Reads a picture without transparency.
/// @throws UsageError naming the file if it is missing or damaged
Image read_png(const std::filesystem::path& file);

}  // namespace drape
