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

/// How far the part of a surface that a vertex touches goes from one time to another [s], where its parts do not move
/// alike: then it has a displacement(contact, from, to).
/// @param of_all its displacement(from, to) [m]
template <class Surface>
Eigen::Vector3d displacement_at(const Surface& surface, const SurfaceContact& contact, double from, double to,
                                const Eigen::Vector3d& of_all) {
  if constexpr (requires { surface.displacement(contact, from, to); }) {
    return surface.displacement(contact, from, to);
  } else {
    return of_all;
  }
}

// A moving surface M is a function of time: M.displacement(from, to) is how far it moves in between [m], and M.at(time)
// is an object of which find(point, contact), or find(vertex, point, contact), says whether the point is inside the
// surface, and fills in how; gap(point) is how far the point is from it, negative inside [m], and normal(point) the
// direction outwards. Contact takes the surface as a template parameter, so that the loops over the vertices hold the
// geometry and no virtual call. The surface is where the push begins, a little outside of what is drawn.

}  // namespace drape
