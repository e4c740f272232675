#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "output/gif/color_histogram.hpp"

namespace drape::gif {

/// The colours of a GIF, by their index.
struct Palette {
  static constexpr int transparent = 0;     ///< the index that shows what was there before
  std::array<std::uint32_t, 256> colors{};  ///< 0xRRGGBB; that of the transparent index means nothing
  std::vector<std::uint32_t> exact;         ///< 0xRRGGBB, ascending: those in `colors` that no pixel may differ from
};

/// Chooses the colours of a GIF for a film.
Palette make_palette(const ColorHistogram& histogram);

}  // namespace drape::gif
