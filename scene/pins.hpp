#pragma once

#include <vector>

#include "scene/document.hpp"
#include "scene/problems.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// Reads an array of vertices: numbers from 0; "corner:x-y+", the vertex farthest in that direction, the first of
/// several; and { box = [[x, y, z], [x, y, z]] }, every vertex between two opposite corners, at least one.
/// @param mesh as it is before it is placed in the world; null if it could not be read: then only the forms are checked
std::vector<int> read_pins(const TomlValue& value, const Mesh* mesh, Problems& problems);

}  // namespace drape
