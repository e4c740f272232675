#include "drape/core/rotation.hpp"

#include <cmath>

namespace drape {

// With n the direction and θ its angle to z: the axis z × n has the length sin θ = 2 sin θ/2 cos θ/2, and
// 2 cos² θ/2 = 1 + cos θ = sin² θ / (1 − cos θ), of which the latter loses no digits below.
Eigen::Quaterniond rotation_from_z(const Eigen::Vector3d& to) {
  const Eigen::Vector3d n = to.normalized();
  const double twice = n.z() > 0 ? 1 + n.z() : n.head<2>().squaredNorm() / (1 - n.z());
  if (twice == 0) return {0, 1, 0, 0};
  const double s = std::sqrt(2 * twice);
  return {s / 2, -n.y() / s, n.x() / s, 0};
}

}  // namespace drape
