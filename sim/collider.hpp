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
  double radius = 1;                                 ///< as it is drawn [m]
  double reach = 0;                                  ///< where it pushes: within this distance of its centre [m]
};

/// A half-space: everything with normal·x ≤ height is inside it.
struct GroundShape {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit vector out of it
  double height = 0;                                  ///< of its surface above the origin, along the normal [m]
  double thickness = 0;                               ///< of the layer above it in which it pushes [m]
};

/// A triangle mesh at one moment.
struct MeshShape {
  std::shared_ptr<const std::vector<Triangle>> triangles;  ///< the same ones at every moment
  Vertices positions;                                      ///< n×3 [m]
  double thickness = 0;                                    ///< of the layer around it in which it pushes [m]
};

/// The shape of something the cloth can touch, at one moment: what a drawing shows of it.
using Collider = std::variant<SphereShape, GroundShape, MeshShape>;

}  // namespace drape
