#pragma once

#include <Eigen/Core>
#include <cmath>

namespace drape {

/// A vector of length 1 in a direction, also where the square of its length overflows or vanishes.
inline Eigen::Vector3d unit_vector(const Eigen::Vector3d& v) {
  return std::isnormal(v.squaredNorm()) ? v.normalized() : v.stableNormalized();
}

}  // namespace drape
