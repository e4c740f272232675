#pragma once

// Example:
//   drape::Image image(480, 400);
//   image.at(10, 20)[0] = 255;  // red, of column 10 and row 20

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "drape/core/rgb.hpp"

namespace drape {

/// An opaque picture: 8-bit sRGB-encoded red, green, blue, rows from top to bottom without padding.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  ///< 3·width·height bytes

  Image() = default;
  Image(int columns, int rows)
      : width(columns), height(rows), pixels(3 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}

  [[nodiscard]] std::uint8_t* at(int x, int y) {
    return pixels.data() +
           3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
  [[nodiscard]] const std::uint8_t* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
  bool operator==(const Image&) const = default;
};

/// Converts an sRGB-encoded value in [0, 1] to linear light in [0, 1] (IEC 61966-2-1).
inline double srgb_to_linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Inverts srgb_to_linear().
inline double linear_to_srgb(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

inline Eigen::Vector3f linear_color(const Rgb& color) {
  return Eigen::Vector3d(srgb_to_linear(color.r), srgb_to_linear(color.g), srgb_to_linear(color.b)).cast<float>();
}

struct ImageSize {
  int width = 0, height = 0;  ///< [pixels]
};

/// Reads the picture size from the beginning of a PNG or JPEG file, so that a huge picture is refused before memory is
/// allocated. Returns nothing for other formats and damaged files.
std::optional<ImageSize> size_in_header(std::span<const unsigned char> bytes);

/// Arranges pictures of one size row after row, with a grey gap between them; unused places in the last row are grey.
/// @param pictures at least one
/// @param columns  pictures per row, at least 1
/// @param gap      between two pictures [pixels]
/// @throws std::invalid_argument if the pictures have different sizes
Image montage(const std::vector<const Image*>& pictures, int columns, int gap, std::uint8_t gray);

/// Appends a picture of the same width below another.
void append_below(Image& upper, const Image& lower);

/// Largest width and height of a texture in llvmpipe [pixels].
constexpr int largest_texture = 16384;

/// One level of a mipmap: 16 bits of linear light per channel, red, green, blue, rows from bottom to top.
struct TextureLevel {
  int width = 0, height = 0;
  std::vector<std::uint16_t> pixels;  ///< 3·width·height
};

/// Reads an image file in any format of OpenCV and makes its mipmap: level 0 as in the file, each next one half as wide
/// and high, rounded down, until 1×1. Averages are taken in linear light; averages of sRGB values would be too dark.
/// @param largest greatest allowed width and height [pixels]
/// @throws UsageError naming the file if it is missing, damaged or no image, too large, or does not fit into memory
std::vector<TextureLevel> load_texture_image(const std::filesystem::path& file, int largest = largest_texture);

/// Checks that load_texture_image() will succeed, before any work is done for it.
/// @throws UsageError as load_texture_image()
void require_texture_image(const std::filesystem::path& file, int largest = largest_texture);

}  // namespace drape
