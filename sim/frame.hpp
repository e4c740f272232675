#pragma once

// Example:
//   const auto frame_of = [](const drape::Simulation& simulation) {
//     return drape::Frame{.time = simulation.time(),
//                         .positions = simulation.state().x,
//                         .colliders = simulation.colliders(simulation.time())};
//   };

#include <optional>
#include <vector>

#include "sim/collider.hpp"
#include "sim/energies.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// One moment of a motion: all positions, as needed for drawing, and optional velocities and energies of the cloth.
struct Frame {
  int index = 0;                          ///< number of the frame, from 0
  double time = 0;                        ///< in the scene's time [s]
  Vertices positions = {};                ///< n×3 [m]
  std::vector<Collider> colliders = {};   ///< in the order of the scene
  Vertices velocities = {};               ///< n×3 [m/s]; empty unless asked for
  std::optional<Energies> energies = {};  ///< absent unless asked for
  int iterations = 0;                     ///< of the step that contains or ends at this moment
};

}  // namespace drape
