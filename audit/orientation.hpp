#pragma once

#include <Eigen/Core>

namespace drape::audit {

/// The exact sign of the volume that b−a, c−a and d−a span: 1 where d is on the side from which a, b, c turn
/// counterclockwise, −1 on the other, 0 in their plane.
///
/// A floating-point filter with Shewchuk's error bound decides most cases, exact expansions the others.
/// Coordinates as in `exact_range`.
int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d);

}  // namespace drape::audit
