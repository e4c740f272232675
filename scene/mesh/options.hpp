#pragma once

#include <optional>
#include <string>

namespace drape {

/// What a scene says about a mesh file beside its name.
struct MeshOptions {
  enum class Up { y, z };

  std::string prim = {};                         ///< of a USD file, "/World/cloth"; empty: the only mesh
  std::optional<Up> up = {};                     ///< of an OBJ, which cannot say it itself; without it z
  std::optional<double> frames_per_second = {};  ///< of an OBJ sequence; without it 24
};

}  // namespace drape
