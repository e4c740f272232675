#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "output/gif/color_histogram.hpp"

namespace drape::gif {

/// Few colours that stand for many: at most `most` of them, and exactly those given if they are no more than that.
///
/// The colours are cut into boxes (Heckbert, "Color image quantization for frame buffer display", 1982), each time
/// there where it takes most from the squared error of all pixels (Wu, "Color quantization by dynamic programming and
/// principal analysis", 1992), and each box becomes its mean.
std::vector<std::uint32_t> representative_colors(std::vector<ColorCount> colors, std::size_t most);

}  // namespace drape::gif
