#pragma once

#include <string>
#include <vector>

namespace drape {

/// Registers what a frame of a film takes as a GIF: CASE/drape, from the picture to the file that was read back, and
/// CASE/ffmpeg, palettegen and paletteuse in memory. Returns the names of the cases.
std::vector<std::string> register_encoding();

}  // namespace drape
