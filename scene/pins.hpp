#pragma once

#include <vector>

#include "scene/document.hpp"
#include "scene/problems.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// Reads an array of vertices: numbers from 0; "corner:x-y+", the vertex farthest in that direction, the first of
/// several; and { box = [[x, y, z], [x, y, z]] }, every vertex between two opposite corners, at least one.
/// @param vertices where they are before the mesh is placed in the world; null if they could not be read: then only the
///                 forms are checked
/// @returns them ascending, each once
std::vector<int> read_pins(const TomlValue& value, const Vertices* vertices, Problems& problems);

}  // namespace drape
