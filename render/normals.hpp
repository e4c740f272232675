#pragma once

#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// n×3: the unit normal of each vertex, the sum of the normals of its triangles weighted by their areas, so that
/// triangles pressed flat do not count. +z where there is none. Summed in the order of the triangles.
Vertices vertex_normals(const Vertices& positions, const std::vector<Triangle>& triangles);

}  // namespace drape
