#pragma once

#include <cstdint>
#include <vector>

#include "output/gif/color_table.hpp"
#include "render/image.hpp"

namespace drape::gif {

/// A colour and its number of pixels.
struct ColorCount {
  std::uint32_t color = 0;  ///< 0xRRGGBB
  std::uint64_t count = 0;
};

/// Counts every colour of a film separately.
class ColorHistogram {
 public:
  void add(const Image& image);

  /// Returns each colour once, in an order that depends only on the set of colours.
  [[nodiscard]] std::vector<ColorCount> colors() const;

 private:
  ColorTable<std::uint64_t> counts_;
};

}  // namespace drape::gif
