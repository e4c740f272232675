#include "output/gif/color_histogram.hpp"

namespace drape::gif {

void ColorHistogram::add(const Image& image) {
  // Counts by runs: much of a picture is uniform background.
  const std::uint8_t* pixel = image.pixels.data();
  const std::uint8_t* end = pixel + image.pixels.size();
  while (pixel != end) {
    const std::uint32_t color = rgb_number(pixel);
    const std::uint8_t* begin = pixel;
    do pixel += 3;
    while (pixel != end && rgb_number(pixel) == color);
    counts_[color] += static_cast<std::uint64_t>(pixel - begin) / 3;
  }
}

std::vector<ColorCount> ColorHistogram::colors() const {
  std::vector<ColorCount> found;
  counts_.for_each([&found](std::uint32_t color, std::uint64_t count) {
    if (count > 0) found.push_back({color, count});
  });
  return found;
}

}  // namespace drape::gif
