#pragma once

#include <string>
#include <vector>

#include "scene/mesh/source.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// An object of an OBJ file as a mesh of its own.
struct ObjObject {
  std::string name;
  Mesh mesh;
};

/// Reads the objects of an OBJ that drape has written, the cloth first: it holds what the cloth may touch, too. Of any
/// other OBJ none, as its objects may be parts of one cloth.
/// @throws UsageError as read_obj_mesh()
std::vector<ObjObject> read_drape_objects(const SourceText& source);

}  // namespace drape
