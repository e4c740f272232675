#pragma once

#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// Returns the n×3 unit normals of the vertices. Each sums its triangles' normals, weighted by area, in the order of
/// the triangles; flattened triangles have no weight. A vertex without a normal gets +z.
Vertices vertex_normals(const Vertices& positions, const std::vector<Triangle>& triangles);

}  // namespace drape
