#pragma once

#include <Eigen/Core>
#include <variant>

namespace drape {

/// A sphere at one moment.
struct SphereShape {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m]
  double radius = 1;                                 ///< [m]
};

/// The shape of something the cloth can touch, at one moment: what a drawing shows of it.
using Collider = std::variant<SphereShape>;

}  // namespace drape
