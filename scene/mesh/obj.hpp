#pragma once

#include <string>
#include <vector>

#include "scene/mesh/source.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// Reads the mesh of a Wavefront OBJ file: all objects and groups together. Vertices keep their file order, including
/// unused ones. Faces may have any number of corners; negative (relative) numbers count back from the last vertex. OBJ
/// has no unit and no up axis: coordinates are taken as metres with z up. Materials, normals, lines and curves are
/// ignored.
/// @throws UsageError "file:line:column: message"
Mesh read_obj_mesh(const SourceText& source);

/// Returns the vertices of the faces of a group ('g') or an object ('o'), ascending.
/// @throws UsageError as above, and if there is no such group
std::vector<int> read_obj_group(const SourceText& source, const std::string& group);

}  // namespace drape
