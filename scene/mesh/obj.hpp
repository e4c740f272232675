#pragma once

#include <string>
#include <vector>

#include "drape/sim/mesh.hpp"
#include "scene/mesh/source.hpp"

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

/// An object of an OBJ file as a separate mesh.
struct ObjObject {
  std::string name;
  Mesh mesh;
};

/// Reads the objects of an OBJ file written by drape: the cloth first, then its obstacles. For any other OBJ returns
/// nothing, because its objects may be parts of one cloth.
/// @throws UsageError as read_obj_mesh()
std::vector<ObjObject> read_drape_objects(const SourceText& source);

}  // namespace drape
