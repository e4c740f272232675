#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/mesh.hpp"

namespace drape::audit {

/// A mesh's triangles and its edges, each once. Made once for all steps of a motion.
struct Topology {
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
};

/// @throws std::invalid_argument if a triangle has a negative vertex or twice the same one
Topology make_topology(std::vector<Triangle> triangles);

/// A mesh at one moment. Refers to what it is made of.
struct Surface {
  const Topology& topology;
  const Vertices& x;  ///< [m]
};

/// A mesh in one step: all vertices move on straight lines, x(t) = from + t (to − from) for t in [0, 1].
struct SurfaceMotion {
  const Topology& topology;
  const Vertices& from;  ///< [m]
  const Vertices& to;    ///< [m]
};

/// Names the mesh that a feature belongs to.
enum class Owner { cloth, body };

/// "cloth vertex 3", "body edge 3 4", "cloth triangle 3 4 5"
std::string describe(Owner owner, std::vector<int> vertices);

}  // namespace drape::audit
