#pragma once

#include <Eigen/Core>

namespace drape {

/// A vertex that a surface pushes.
struct SurfaceContact {
  Eigen::Vector3d outward;  ///< the direction out of the surface, of any length but 0 [m]
  double length = 1;        ///< of that [m]
  double gap = 0;           ///< from the surface to the vertex, along the normal: negative, as it is inside [m]

  [[nodiscard]] Eigen::Vector3d normal() const { return outward / length; }
};

// A moving surface M is a function of time: M.displacement(from, to) is how far it moves in between [m], and M.at(time)
// is an object of which find(point, contact) says whether the point is inside the surface, and fills in how; gap(point)
// is how far the point is from it, negative inside [m], and normal(point) the direction outwards. Contact takes the
// surface as a template parameter, so that the loops over the vertices hold the geometry and no virtual call. The
// surface is where the push begins, a little outside of what is drawn.

}  // namespace drape
