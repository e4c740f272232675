#pragma once

#include <string>
#include <vector>

namespace drape {

/// Registers the drawing of a frame with the default look, and without shadows, ambient occlusion and translucency, as
/// CASE/with and CASE/without. Returns the names of the cases.
std::vector<std::string> register_drawing();

}  // namespace drape
