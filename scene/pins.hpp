#pragma once

#include <vector>

#include "scene/document.hpp"
#include "scene/problems.hpp"
#include "scene/selection.hpp"

namespace drape {

/// Reads an array of vertices. Items are numbers from 0; "corner:x-y+", the vertex farthest in that direction (the
/// first of several); "edge:x-", all vertices farthest in that direction; "border", the border of the mesh; and tables
/// that select at least one vertex, see read_selection().
/// @param mesh null if it could not be read: then only the forms are checked
/// @returns vertices, ascending and unique
std::vector<int> read_pins(const TomlValue& value, const SelectableMesh* mesh, Problems& problems);

}  // namespace drape
