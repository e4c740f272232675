#pragma once

#include <string>
#include <vector>

#include "sim/settings.hpp"

namespace drape {

/// Vertices of a cloth that are inside of something before the first step.
struct StartOverlap {
  std::size_t collider;  ///< as in Simulation::colliders()
  std::string kind;      ///< "sphere", "ground" or "body"
  int vertices = 0;      ///< that are not pinned
  double depth = 0;      ///< of the deepest, below the surface that is drawn [m]
};

/// Where a cloth starts inside of spheres, grounds and solid bodies: what is deep in one is thrown out of it.
std::vector<StartOverlap> start_overlaps(const SimulationSettings& settings);

/// What of it there is to say: "12 vertices of the cloth start inside the body, the deepest 0.03 m: …".
std::string describe(const StartOverlap& overlap);

}  // namespace drape
