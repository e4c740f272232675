#pragma once

#include <string>
#include <vector>

#include "overlay/axis_ticks.hpp"
#include "overlay/pen.hpp"
#include "render/image.hpp"

namespace drape {

/// Colours of the bands below pictures: black on white, as in a figure.
inline const Rgb band_paper{1, 1, 1}, band_ink{0.12, 0.12, 0.13};

/// Returns the height of a colour bar with its labels [pixels].
/// @param size font size [pixels]
int color_bar_height(int size);

/// Draws the colours of viridis() from left to right, with a title above and labels below.
/// @param marks labels; their values are positions in the bar, from 0 to 1
Image color_bar(Pen& pen, int width, int size, const std::string& title, const std::vector<Tick>& marks);

}  // namespace drape
