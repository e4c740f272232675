#pragma once

#include <vector>

#include "scene/document.hpp"
#include "scene/problems.hpp"
#include "scene/selection.hpp"

namespace drape {

/// Reads an array of vertices: numbers from 0; "corner:x-y+", the vertex farthest in that direction, the first of
/// several; "edge:x-", all that are as far in that direction as the farthest; "border", the mesh's border; and tables
/// that select at least one, see read_selection().
/// @param mesh null if it could not be read: then only the forms are checked
/// @returns them ascending, each once
std::vector<int> read_pins(const TomlValue& value, const SelectableMesh* mesh, Problems& problems);

}  // namespace drape
