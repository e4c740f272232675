#pragma once

#include <Eigen/Geometry>

namespace drape {

/// Returns the shortest rotation that takes the z axis to the direction of `to`, a vector of any length but zero. For
/// −z it is half a turn around the x axis. Eigen's FromTwoVectors would compile a singular value decomposition.
Eigen::Quaterniond rotation_from_z(const Eigen::Vector3d& to);

}  // namespace drape
