#pragma once

#include <cstddef>
#include <vector>

#include "render/image.hpp"

namespace drape {

/// Encodes a film as a GIF in memory with FFmpeg's defaults: palettegen over all frames, then paletteuse, the GIF
/// encoder and the muxer, in one thread.
/// @returns the size of the GIF [bytes]
/// @throws std::runtime_error
std::size_t encode_gif_by_ffmpeg(const std::vector<Image>& film, int fps);

}  // namespace drape
