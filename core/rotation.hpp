#pragma once

#include <Eigen/Geometry>

namespace drape {

/// The shortest rotation that takes the z axis to the direction of `to`, of any length but zero; half a turn around the
/// x axis where that is −z. Eigen's own for any two directions is compiled with a singular value decomposition.
Eigen::Quaterniond rotation_from_z(const Eigen::Vector3d& to);

}  // namespace drape
