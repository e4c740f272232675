#include "render/montage.hpp"

#include <algorithm>
#include <stdexcept>

namespace drape {

Image montage(const std::vector<const Image*>& pictures, int columns, int gap, std::uint8_t gray) {
  const int count = static_cast<int>(pictures.size());
  const int across = std::min(columns, count), down = (count + columns - 1) / columns;
  const int width = pictures.front()->width, height = pictures.front()->height;
  Image whole(across * width + (across - 1) * gap, down * height + (down - 1) * gap);
  std::fill(whole.pixels.begin(), whole.pixels.end(), gray);
  for (int i = 0; i < count; ++i) {
    const Image& picture = *pictures[static_cast<std::size_t>(i)];
    if (picture.width != width || picture.height != height) {
      throw std::invalid_argument("pictures of different sizes cannot be put side by side");
    }
    const int left = i % columns * (width + gap), top = i / columns * (height + gap);
    for (int y = 0; y < height; ++y) std::copy_n(picture.at(0, y), 3 * width, whole.at(left, top + y));
  }
  return whole;
}

}  // namespace drape
