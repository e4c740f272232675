#pragma once

#include <optional>
#include <vector>

#include "sim/cloth.hpp"

namespace drape {

/// The numbers that vertices have in another mesh: vertex i of this one is vertex order[i] of that one.
using VertexOrder = std::vector<int>;

/// The mean length of the triangles' sides [m]; 0 without triangles.
double mean_edge(const Vertices& x, const std::vector<Triangle>& triangles);

/// Matches the vertices of two meshes by their positions.
/// @param tolerance the largest distance of two that match [m]
/// @returns for each vertex of `x` the one of `other`; nothing unless each has exactly one within the tolerance
std::optional<VertexOrder> match_vertices(const Vertices& x, const Vertices& other, double tolerance);

/// Returns rows in another order: row i is row order[i] of `x`.
Vertices in_order(const Vertices& x, const VertexOrder& order);

/// Numbers a cloth's vertices anew: vertex i is the one that was order[i].
Cloth in_order(Cloth cloth, const VertexOrder& order);

}  // namespace drape
