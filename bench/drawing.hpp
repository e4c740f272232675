#pragma once

#include <string>
#include <vector>

namespace drape {

/// Registers the drawing of a frame with all that a look has by default, and with shadows, ambient occlusion and
/// translucency switched off, as CASE/with and CASE/without. Returns the names of the cases.
std::vector<std::string> register_drawing();

}  // namespace drape
