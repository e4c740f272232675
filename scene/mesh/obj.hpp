#pragma once

#include <string>
#include <vector>

#include "scene/mesh/source.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// The mesh of a Wavefront OBJ file: all its objects and groups together, its vertices in their order in the file, also
/// those no face uses. Faces may have any number of corners; negative (relative) numbers count back from the last
/// vertex. OBJ knows neither units nor an up axis: the coordinates are taken as metres with z up. Materials, normals,
/// lines and curves are passed over.
/// @throws UsageError "file:line:column: message"
Mesh read_obj_mesh(const SourceText& source);

/// The vertices of the faces of a group ('g') or an object ('o'), ascending.
/// @throws UsageError as above, and if there is no such group
std::vector<int> read_obj_group(const SourceText& source, const std::string& group);

}  // namespace drape
