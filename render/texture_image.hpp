#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace drape {

/// One level of a mipmap: 16 bits of linear light per channel, red, green, blue, rows from bottom to top.
struct TextureLevel {
  int width = 0, height = 0;
  std::vector<std::uint16_t> pixels;  ///< 3·width·height
};

/// Reads an image file in any format of OpenCV and makes its mipmap: level 0 as in the file, each next one half as wide
/// and high, rounded down, until 1×1. The averages are of linear light; of sRGB values they would come out too dark.
/// @throws UsageError naming the file if it is missing, damaged or no image
std::vector<TextureLevel> load_texture_image(const std::filesystem::path& file);

}  // namespace drape
