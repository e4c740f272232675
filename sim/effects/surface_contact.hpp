#pragma once

#include <Eigen/Core>

namespace drape {

/// A vertex that a surface pushes.
struct SurfaceContact {
  Eigen::Vector3d outward;  ///< the direction out of the surface, of any length but 0 [m]
  double length = 1;        ///< of that [m]
  double gap = 0;           ///< from the surface to the vertex, along the normal: negative, as it is inside [m]

  // Of a mesh, where on it that is.
  int triangle = -1;
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();  ///< of the triangle's corners

  [[nodiscard]] Eigen::Vector3d normal() const { return outward / length; }
};

/// Whether a vertex is inside a surface, and how: see below. What remembers where vertices were is told which it is.
template <class Shape>
bool find_contact(const Shape& shape, Eigen::Index vertex, const Eigen::Vector3d& point, SurfaceContact& contact) {
  if constexpr (requires { shape.find(vertex, point, contact); }) {
    return shape.find(vertex, point, contact);
  } else {
    return shape.find(point, contact);
  }
}

/// How far the parts of a surface go in a while, where all of them go alike.
struct CommonWay {
  Eigen::Vector3d all;  ///< [m]

  [[nodiscard]] const Eigen::Vector3d& of(const SurfaceContact&) const { return all; }
};

/// How far the part of a surface that a vertex touches goes from one time to another [s]: of(contact) of what this
/// returns. Where the parts do not move alike, the surface has a way(from, to).
template <class Surface>
auto way_of(const Surface& surface, double from, double to) {
  if constexpr (requires { surface.way(from, to); }) {
    return surface.way(from, to);
  } else {
    return CommonWay{surface.displacement(from, to)};
  }
}

// A moving surface M is a function of time: M.displacement(from, to) is how far it moves in between [m], and M.at(time)
// is an object of which find(point, contact), or find(vertex, point, contact), says whether the point is inside the
// surface, and fills in how; gap(point) is how far the point is from it, negative inside [m], and normal(point) the
// direction outwards. Contact takes the surface as a template parameter, so that the loops over the vertices hold the
// geometry and no virtual call. What at(time) returns is asked by several threads at once, of a vertex by one of them.
// The surface is where the push begins, a little outside of what is drawn.

}  // namespace drape
