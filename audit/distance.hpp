#pragma once

#include <Eigen/Core>
#include <array>

namespace drape::audit {

/// The square of the distance from a point to a triangle, its border included [m²]. Rounded.
double square_distance(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& triangle);

}  // namespace drape::audit
