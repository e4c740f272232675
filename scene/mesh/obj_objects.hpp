#pragma once

#include <string>
#include <vector>

#include "scene/mesh/source.hpp"
#include "sim/mesh.hpp"

namespace drape {

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
