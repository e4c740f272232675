#pragma once

#include <array>
#include <vector>

#include "sim/collision/distance.hpp"
#include "sim/collision/spatial_hash.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// A triangle with those of its vertices and edges that no earlier triangle owns. So a search by triangles finds each
/// feature once (Curtis, Tamstorf and Manocha 2008, "Fast collision detection for deformable models using
/// representative-triangles").
struct Patch {
  Triangle corners;
  std::array<bool, 3> own_vertex, own_edge;  ///< edge c leads from corner c to c + 1
};

/// Returns the patches of a mesh, in the order of its triangles.
/// @param first number of the mesh's first vertex
std::vector<Patch> make_patches(const std::vector<Triangle>& triangles, int first, int vertex_count);

/// Returns the box around a patch on straight paths, enlarged by a margin [m].
Box swept_box(const Patch& patch, const std::vector<Point>& from, const std::vector<Point>& to, double margin);

}  // namespace drape
