#pragma once

#include <optional>
#include <vector>

#include "drape/sim/cloth.hpp"

namespace drape {

/// Map between the vertices of two meshes: vertex i of one is vertex order[i] of the other.
using VertexOrder = std::vector<int>;

/// Matches the vertices of two meshes by their positions.
/// @param tolerance largest distance of a matching pair [m]
/// @returns for each vertex of `x` its partner in `other`; nothing unless each has exactly one within the tolerance
std::optional<VertexOrder> match_vertices(const Vertices& x, const Vertices& other, double tolerance);

/// Reorders rows: row i of the result is row order[i] of `x`.
Vertices in_order(const Vertices& x, const VertexOrder& order);

/// Renumbers a cloth's vertices: vertex i of the result is vertex order[i].
Cloth in_order(Cloth cloth, const VertexOrder& order);

}  // namespace drape
