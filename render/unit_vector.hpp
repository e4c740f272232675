#pragma once

#include <Eigen/Core>
#include <cmath>

namespace drape {

/// Normalises a vector, even if its squared length overflows or underflows.
inline Eigen::Vector3d unit_vector(const Eigen::Vector3d& v) {
  return std::isnormal(v.squaredNorm()) ? v.normalized() : v.stableNormalized();
}

}  // namespace drape
