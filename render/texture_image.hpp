#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace drape {

/// What llvmpipe can draw: the width and height of a texture [pixels].
constexpr int largest_texture = 16384;

/// One level of a mipmap: 16 bits of linear light per channel, red, green, blue, rows from bottom to top.
struct TextureLevel {
  int width = 0, height = 0;
  std::vector<std::uint16_t> pixels;  ///< 3·width·height
};

/// Reads an image file in any format of OpenCV and makes its mipmap: level 0 as in the file, each next one half as wide
/// and high, rounded down, until 1×1. The averages are of linear light; of sRGB values they would come out too dark.
/// @param largest that its width and height may be [pixels]
/// @throws UsageError naming the file if it is missing, damaged or no image, too large, or does not fit into memory
std::vector<TextureLevel> load_texture_image(const std::filesystem::path& file, int largest = largest_texture);

/// Looks, before any work is done for it, whether load_texture_image() will do.
/// @throws UsageError as that
void require_texture_image(const std::filesystem::path& file, int largest = largest_texture);

}  // namespace drape
