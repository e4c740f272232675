#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "output/gif/color_histogram.hpp"

namespace drape::gif {

/// Chooses at most `most` colours that represent the given ones; few given colours are returned unchanged.
///
/// The colours are cut into boxes (Heckbert, "Color image quantization for frame buffer display", 1982), each time
/// where the squared error of all pixels falls most (Wu, "Color quantization by dynamic programming and principal
/// analysis", 1992). Each box becomes its mean.
std::vector<std::uint32_t> representative_colors(std::vector<ColorCount> colors, std::size_t most);

}  // namespace drape::gif
