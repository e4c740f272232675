#pragma once

#include <vector>

#include "sim/cloth.hpp"

namespace drape {

/// An edge and one of the triangles at it.
struct EdgeSide {
  Edge edge;
  int triangle;
  int opposite;  ///< the triangle's vertex that is not on the edge
};

/// Every side of every triangle, sorted by edge and then by triangle: the sides of an edge follow each other. Triangles
/// with the same vertex twice have none.
std::vector<EdgeSide> edge_sides(const std::vector<Triangle>& triangles);

/// Calls visit(side, next) for every side of every edge that two or more triangles share, with the side that follows it
/// around the edge: both ways round where there are two, in a ring where there are more. Sides opposite of which is the
/// same vertex, as in duplicated triangles, are left out.
template <class Visit>
void for_neighbours(const std::vector<EdgeSide>& sides, Visit&& visit) {
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
    if (last - first < 2) continue;
    for (std::size_t s = first; s < last; ++s) {
      const EdgeSide& next = sides[s + 1 < last ? s + 1 : first];
      if (sides[s].opposite != next.opposite) visit(sides[s], next);
    }
  }
}

/// The "cross" springs against bending: one between the vertices opposite to each edge that two triangles share, as
/// long as they are apart in the rest shape. Sorted by vertices, none twice; vertices that an edge joins already have
/// none.
/// @param stiffness of each [N/m]
std::vector<Spring> cross_springs(const Cloth& cloth, double stiffness);

}  // namespace drape
