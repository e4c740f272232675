#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace drape {

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
