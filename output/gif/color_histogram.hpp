#pragma once

#include <cstdint>
#include <vector>

#include "output/gif/color_table.hpp"
#include "render/image.hpp"

namespace drape::gif {

/// A colour and how many pixels have it.
struct ColorCount {
  std::uint32_t color = 0;  ///< 0xRRGGBB
  std::uint64_t count = 0;
};

/// Counts every colour of a film by itself.
class ColorHistogram {
 public:
  void add(const Image& image);

  /// Each colour that there is, once, in an order that depends on nothing else.
  [[nodiscard]] std::vector<ColorCount> colors() const;

 private:
  ColorTable<std::uint64_t> counts_;
};

}  // namespace drape::gif
