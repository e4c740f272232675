#pragma once

#include <string>

#include "sim/mesh.hpp"

namespace drape::test {

/// How many pairs of an edge and a triangle without a common vertex intersect, by trying all of them: the sign of the
/// volumes that the edge's ends and the triangle's sides span.
int self_intersections(const std::vector<Triangle>& triangles, const Vertices& x);

/// How many edges and triangles without a common vertex, or vertices and triangles, went through each other while the
/// vertices moved on straight lines from one place to the other, by trying all of them: the times at which four points
/// are coplanar are roots of a cubic, and at such a time the features either touch or do not.
int self_crossings(const std::vector<Triangle>& triangles, const Vertices& from, const Vertices& to);

}  // namespace drape::test
