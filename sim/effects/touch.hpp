#pragma once

#include <Eigen/Core>

namespace drape {

/// A vertex within a surface's reach.
struct Touch {
  Eigen::Vector3d away;  ///< points outwards [m]
  double distance = 1;   ///< the length of it, above 0 [m]
  double depth = 0;      ///< below the reach [m]

  [[nodiscard]] Eigen::Vector3d normal() const { return away / distance; }
};

// A moving surface M is a function of time: M.displacement(from, to) is how far it moves in between [m], and M.at(time)
// is an object of which find(point, touch) says whether the point is within reach, and fills in how; clearance(point)
// is how far beyond that it is, negative within [m], and normal(point) the direction outwards. Contact takes the
// surface as a template parameter, so that the loops over the vertices hold the geometry and no virtual call.

}  // namespace drape
