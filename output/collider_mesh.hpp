#pragma once

#include "sim/collider.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// Surface of colliders, for formats with only triangles.
struct Surface {
  Vertices positions;  ///< n×3 [m]
  std::vector<Triangle> triangles;
};

/// Part of an infinite ground that is shown: a square around the initial cloth.
struct GroundPatch {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of the cloth; projected onto the ground [m]
  double side = 4;                                   ///< side of the square [m]
};

/// Returns a patch four times as wide as the cloth.
GroundPatch ground_patch(const Vertices& cloth);

/// Returns the corners of a square of a ground, counterclockwise seen from above it: 4×3 [m].
Vertices ground_corners(const GroundShape& ground, const GroundPatch& patch);

/// Returns all colliders as one surface: inscribed spheres of 48 by 24 parts, and squares of grounds.
Surface surface_of(const std::vector<Collider>& colliders, const GroundPatch& patch);

}  // namespace drape
