#pragma once

// Example:
//   drape::Image image(480, 400);
//   image.at(10, 20)[0] = 255;  // red, of column 10 and row 20

#include <cstddef>
#include <cstdint>
#include <vector>

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

}  // namespace drape
