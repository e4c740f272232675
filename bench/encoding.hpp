#pragma once

#include <string>
#include <vector>

namespace drape {

/// Registers the encoding of a film's frame as a GIF: CASE/drape, from the picture to the verified file, and
/// CASE/ffmpeg, palettegen and paletteuse in memory. Returns the names of the cases.
std::vector<std::string> register_encoding();

}  // namespace drape
