#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/mesh.hpp"

namespace drape::audit {

/// Triangles and unique edges of a mesh. Made once for all steps of a motion.
struct Topology {
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
};

/// Extracts the edges. @throws std::invalid_argument if a triangle has a negative or a repeated vertex
Topology make_topology(std::vector<Triangle> triangles);

/// A mesh at one moment. Refers to its data.
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

/// The mesh that owns a feature.
enum class Owner { cloth, body };

/// Returns for example "cloth vertex 3", "body edge 3 4", "cloth triangle 3 4 5".
std::string describe(Owner owner, std::vector<int> vertices);

}  // namespace drape::audit
