#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "output/gif/color_histogram.hpp"

namespace drape::gif {

/// The colours of a GIF, by index.
struct Palette {
  static constexpr int transparent = 0;     ///< index that keeps the previous pixel
  std::array<std::uint32_t, 256> colors{};  ///< 0xRRGGBB; unused for the transparent index
  std::vector<std::uint32_t> exact;         ///< 0xRRGGBB, ascending: colours that pixels must keep exactly
};

/// Chooses the colours of a GIF for a film.
Palette make_palette(const ColorHistogram& histogram);

}  // namespace drape::gif
