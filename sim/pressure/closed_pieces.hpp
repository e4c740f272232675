#pragma once

#include <vector>

#include "drape/sim/cloth.hpp"

namespace drape {

/// A connected part of a mesh without border: each of its edges has exactly two triangles.
struct ClosedPiece {
  /// Triangles of the mesh, turned so that all fronts face outwards.
  std::vector<Triangle> triangles;
};

/// Returns the pieces of a cloth, in the order of their first triangle. A piece whose triangles face different sides is
/// turned to one orientation: to a positive volume of the rest shape, else of the initial shape. If both are flat, its
/// first triangle keeps its front. Triangles with a repeated vertex belong to no piece.
/// @throws std::invalid_argument with a sentence that names an edge, if the cloth has no triangles or an edge without
///         exactly two, or if a piece has only one side
std::vector<ClosedPiece> closed_pieces(const Cloth& cloth);

/// Returns the volume inside of triangles that face outwards [m³]. It is summed about one of their vertices, so the
/// distance from the origin costs no accuracy.
/// @param x positions, n×3 [m]
double enclosed_volume(const std::vector<Triangle>& triangles, const Vertices& x);

/// Returns the sum of the triangles' areas [m²].
double surface_area(const std::vector<Triangle>& triangles, const Vertices& x);

}  // namespace drape
