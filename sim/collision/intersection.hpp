#pragma once

#include <cstddef>
#include <vector>

#include "sim/collision/distance.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// An edge that passes through a triangle with which it shares no vertex.
struct Intersection {
  Edge edge;
  std::size_t triangle;  ///< its number
};

/// Finds every edge that passes through a triangle, sorted by edges and then by triangles. An edge in a triangle's
/// plane does not pass through it, even if rounding moved vertices out of the plane, as when a flat cloth is turned.
/// Nearly linear in the size of the meshes.
std::vector<Intersection> find_intersections(const std::vector<Edge>& edges, const std::vector<Triangle>& triangles,
                                             const std::vector<Point>& points);

}  // namespace drape
