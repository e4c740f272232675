#pragma once

#include <string>

#include "overlay/pen.hpp"
#include "overlay/settings.hpp"
#include "render/image.hpp"

namespace drape {

/// The size of the text that suits a picture: readable, and no larger than it has to be [pixels].
int text_size(int picture_height);

/// The smallest text that can be read [pixels].
inline constexpr int least_text_size = 6;

/// The largest text, of at most `most` pixels, with which a caption stands in a picture, with a margin around it.
/// @returns 0 if it would have to be smaller than can be read
int largest_caption_size(Pen& pen, const std::string& text, int most, int width, int height);

/// Refuses a caption that does not stand in a picture of this size; one whose scene does not say its size is made
/// smaller instead.
/// @param text as it may be at some moment
/// @throws UsageError with the largest size that does
void require_room(Pen& pen, const CaptionSettings& caption, const std::string& text, int width, int height);

/// Writes a caption into a picture, in as many lines as it takes. One that has grown beyond the picture since the
/// begin of the film is written smaller.
/// @param text       what the caption says at this moment
/// @param background of the picture behind it, for a caption that has no colour
void draw_caption(Image& picture, Pen& pen, const CaptionSettings& caption, const std::string& text,
                  const Rgb& background);

}  // namespace drape
