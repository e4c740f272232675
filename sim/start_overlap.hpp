#pragma once

#include <string>
#include <vector>

#include "sim/settings.hpp"

namespace drape {

/// Vertices of a cloth that start inside of an obstacle.
struct StartOverlap {
  std::size_t collider;  ///< index in Simulation::colliders()
  std::string kind;      ///< "sphere", "ground" or "body"
  int vertices = 0;      ///< number of unpinned vertices
  double depth = 0;      ///< of the deepest vertex, below the drawn surface [m]
};

/// Returns the overlaps of the initial cloth with spheres, grounds and solid bodies, which would throw it out.
std::vector<StartOverlap> start_overlaps(const SimulationSettings& settings);

/// Returns a warning: "12 vertices of the cloth start inside the body, the deepest 0.03 m: …".
std::string describe(const StartOverlap& overlap);

}  // namespace drape
