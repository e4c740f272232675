#pragma once

#include <Eigen/Core>

namespace drape {

/// A value at a moment.
struct Keyframe {
  double time = 0;  ///< [s]
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
};

}  // namespace drape
