#pragma once

#include "sim/collider.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// What colliders look like, for formats that know nothing but triangles.
struct Surface {
  Vertices positions;  ///< n×3 [m]
  std::vector<Triangle> triangles;
};

/// Where a ground is shown, which has no end: around the cloth as it starts.
struct GroundPatch {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of the cloth; what is shown lies below it [m]
  double side = 4;                                   ///< of a square [m]
};

/// Four times as wide as a cloth.
GroundPatch ground_patch(const Vertices& cloth);

/// The corners of a square of a ground, counterclockwise seen from above it: 4×3 [m].
Vertices ground_corners(const GroundShape& ground, const GroundPatch& patch);

/// All colliders as one surface: spheres inscribed, of 48 by 24 parts, and squares of grounds.
Surface surface_of(const std::vector<Collider>& colliders, const GroundPatch& patch);

}  // namespace drape
