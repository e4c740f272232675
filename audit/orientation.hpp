#pragma once

#include <Eigen/Core>

namespace drape::audit {

/// Returns the exact sign of the volume spanned by b−a, c−a and d−a. It is 1 if d is on the side from which a, b, c
/// turn counterclockwise, −1 on the other side, 0 in their plane.
///
/// A floating-point filter with Shewchuk's error bound decides most cases, exact expansions the others.
/// Coordinates as in `exact_range`.
int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d);

}  // namespace drape::audit
