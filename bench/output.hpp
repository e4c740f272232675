#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "drape/render/image.hpp"

namespace drape {

/// Registers the drawing of a frame with the default look, and without shadows, ambient occlusion and translucency, as
/// CASE/with and CASE/without. Returns the names of the cases.
std::vector<std::string> register_drawing();

/// Registers the encoding of a film's frame as a GIF: CASE/drape, from the picture to the verified file, and
/// CASE/ffmpeg, palettegen and paletteuse in memory. Returns the names of the cases.
std::vector<std::string> register_encoding();

/// Encodes a film as a GIF in memory with FFmpeg's defaults: palettegen over all frames, then paletteuse, the GIF
/// encoder and the muxer, in one thread.
/// @returns the size of the GIF [bytes]
/// @throws std::runtime_error
std::size_t encode_gif_by_ffmpeg(const std::vector<Image>& film, int fps);

}  // namespace drape
