#pragma once

#include <Eigen/Core>
#include <array>

namespace drape::audit {

/// Returns the squared distance from a point to a triangle with its boundary [m²]. Rounded.
double square_distance(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& triangle);

}  // namespace drape::audit
