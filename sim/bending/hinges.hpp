#pragma once

#include <vector>

#include "sim/cloth.hpp"

namespace drape {

/// An edge of a triangle.
struct EdgeSide {
  Edge edge;
  int triangle;
  int opposite;  ///< the triangle's third vertex
};

/// Returns every side of every triangle, sorted by edge and then by triangle, so that the sides of an edge are
/// consecutive. Triangles with a repeated vertex have none.
std::vector<EdgeSide> edge_sides(const std::vector<Triangle>& triangles);

/// Calls visit(side, next) for every side of every shared edge, with the next side around the edge: in both directions
/// for two triangles, in a ring for more. Omits sides with the same opposite vertex, as in duplicated triangles.
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

/// Returns the "cross" springs against bending, one between the vertices opposite to each edge shared by two triangles.
/// Their rest length is the distance in the rest shape. Sorted by vertices, without duplicates and without vertices
/// that an edge already joins.
/// @param stiffness of each [N/m]
std::vector<Spring> cross_springs(const Cloth& cloth, double stiffness);

}  // namespace drape
