#pragma once

// Example:
//   const drape::Collider ball = drape::SphereShape{.center = {0, 0, 1}, .radius = 0.4, .reach = 0.44};
//   if (const auto* sphere = std::get_if<drape::SphereShape>(&ball)) std::printf("%g m", sphere->radius);

#include <Eigen/Core>
#include <memory>
#include <variant>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// A sphere at one moment.
struct SphereShape {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m]
  double radius = 1;                                 ///< drawn radius [m]
  double reach = 0;                                  ///< distance from the centre within which it pushes [m]
};

/// A half-space: all points with normal·x ≤ height.
struct GroundShape {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward unit normal
  double height = 0;                                  ///< of the surface above the origin, along the normal [m]
  double thickness = 0;                               ///< of the layer above the surface in which it pushes [m]
};

/// A triangle mesh at one moment.
struct MeshShape {
  std::shared_ptr<const std::vector<Triangle>> triangles;  ///< the same object at every moment
  Vertices positions;                                      ///< n×3 [m]
  double thickness = 0;                                    ///< of the layer around the mesh in which it pushes [m]
};

/// Shape of something that the cloth can touch, at one moment, as drawn.
using Collider = std::variant<SphereShape, GroundShape, MeshShape>;

}  // namespace drape
