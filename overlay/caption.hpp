#pragma once

#include <string>

#include "overlay/pen.hpp"
#include "overlay/settings.hpp"
#include "render/image.hpp"

namespace drape {

/// Returns the default text size for a picture: readable, and no larger than necessary [pixels].
int text_size(int picture_height);

/// Smallest readable text size [pixels].
inline constexpr int least_text_size = 6;

/// Returns the largest text size up to `most` [pixels] with which a caption and its margin fit into a picture.
/// @returns 0 if the caption would be too small to read
int largest_caption_size(Pen& pen, const std::string& text, int most, int width, int height);

/// Refuses a caption of a given size that does not fit into the picture; a caption without a size shrinks instead.
/// @param text longest text that may appear
/// @throws UsageError with the largest size that fits
void require_room(Pen& pen, const CaptionSettings& caption, const std::string& text, int width, int height);

/// Writes a caption into a picture, in as many lines as needed. A caption that has outgrown the picture during the film
/// is written smaller.
/// @param text       text at this moment
/// @param background colour behind it, which decides the colour of a caption without one
void draw_caption(Image& picture, Pen& pen, const CaptionSettings& caption, const std::string& text,
                  const Rgb& background);

}  // namespace drape
