#pragma once

#include <string>
#include <string_view>

#include "import/mesh_frame.hpp"

namespace drape {

/// Reads a PLY mesh: ASCII or binary of either byte order, with x, y, z of the element "vertex" and the list
/// "vertex_indices" or "vertex_index" of the element "face". Other elements and properties are ignored.
/// @param name file name for messages
/// @throws UsageError "name: message"
MeshFrame read_ply(const std::string& name, std::string_view text);

}  // namespace drape
