#pragma once

#include <array>
#include <vector>

#include "sim/collision/distance.hpp"
#include "sim/collision/spatial_hash.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// A triangle of a mesh, with those of its vertices and edges that no triangle before it has: what is looked for with
/// triangles is so found once (Curtis, Tamstorf and Manocha 2008, "Fast collision detection for deformable models using
/// representative-triangles").
struct Patch {
  Triangle corners;
  std::array<bool, 3> own_vertex, own_edge;  ///< the edge from corner c to c + 1
};

/// The patches of a mesh, in the order of its triangles.
/// @param first number that its first vertex gets
std::vector<Patch> make_patches(const std::vector<Triangle>& triangles, int first, int vertex_count);

/// The box around a patch on straight ways, and so much on all sides [m].
Box swept_box(const Patch& patch, const std::vector<Point>& from, const std::vector<Point>& to, double margin);

}  // namespace drape
