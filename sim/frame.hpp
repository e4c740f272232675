#pragma once

#include <vector>

#include "sim/collider.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// What a drawing of one moment needs to know: where everything is.
struct Frame {
  int index = 0;                    ///< number of the frame, from 0
  double time = 0;                  ///< [s], in the scene's time
  Vertices positions;               ///< n×3 [m]
  std::vector<Collider> colliders;  ///< in the order of the scene
};

}  // namespace drape
