#pragma once

#include <string>

#include "drape/sim/mesh.hpp"

namespace drape::test {

/// Counts the intersections of an edge and a triangle without a common vertex, by testing all pairs: the signs of the
/// volumes spanned by the edge's ends and the triangle's sides.
int self_intersections(const std::vector<Triangle>& triangles, const Vertices& x);

/// Counts the pairs of edges, or of a vertex and a triangle, without a common vertex, that pass through each other
/// while the vertices move straight from one position to the other. It tests all pairs: the times at which four points
/// are coplanar are roots of a cubic, and at such a time the features either touch or do not.
int self_crossings(const std::vector<Triangle>& triangles, const Vertices& from, const Vertices& to);

}  // namespace drape::test
