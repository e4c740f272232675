#pragma once

#include <string>
#include <vector>

#include "overlay/axis_ticks.hpp"
#include "overlay/pen.hpp"
#include "render/image.hpp"

namespace drape {

/// Of what stands below pictures: black on white, like a figure's.
inline const Rgb band_paper{1, 1, 1}, band_ink{0.12, 0.12, 0.13};

/// How high a bar of colours is with its words [pixels].
/// @param size of the font [pixels]
int color_bar_height(int size);

/// The colours of viridis() from left to right under a title, with what they stand for below.
/// @param marks their values are places in the bar, from 0 to 1
Image color_bar(Pen& pen, int width, int size, const std::string& title, const std::vector<Tick>& marks);

}  // namespace drape
