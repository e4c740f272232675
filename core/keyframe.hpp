#pragma once

#include <Eigen/Core>

namespace drape {

/// A value at one time.
struct Keyframe {
  double time = 0;  ///< [s]
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
};

}  // namespace drape
