#pragma once

#include <optional>
#include <string>

namespace drape {

/// Options of a mesh file in a scene.
struct MeshOptions {
  enum class Up { y, z };

  std::string prim = {};                         ///< prim of a USD file, "/World/cloth"; empty: the only mesh
  std::optional<Up> up = {};                     ///< up axis of an OBJ, which does not store it; default z
  std::optional<double> frames_per_second = {};  ///< frame rate of an OBJ sequence; default 24
};

}  // namespace drape
