#pragma once

#include <string>

#include "overlay/pen.hpp"
#include "overlay/settings.hpp"
#include "render/image.hpp"

namespace drape {

/// The size of the text that suits a picture: readable, and no larger than it has to be [pixels].
int text_size(int picture_height);

/// Writes a caption into a picture, in as many lines as it takes.
/// @param text       what the caption says at this moment
/// @param background of the picture behind it, for a caption that has no colour
void draw_caption(Image& picture, Pen& pen, const CaptionSettings& caption, const std::string& text,
                  const Rgb& background);

}  // namespace drape
