#pragma once

// Example:
//   const drape::Mesh mesh = drape::make_grid({.columns = 30, .rows = 20, .size = {{1.5, 1}}});

#include <optional>

#include "sim/mesh.hpp"

namespace drape {

/// Division of a grid's cells into triangles.
enum class GridPattern {
  diagonal,     ///< one diagonal, the same in every cell
  alternating,  ///< one diagonal, alternating like the colours of a chessboard
  x,            ///< both diagonals, with a vertex in the middle
  equilateral   ///< rows of triangles, every other row shifted by half a cell
};

/// A rectangle of cells in the plane of x and y, around the origin.
struct Grid {
  int columns = 1, rows = 1;
  GridPattern pattern = GridPattern::diagonal;
  /// Size along x and y [m]. Default: 2 m × 2 m; for equilateral triangles 2 m × √3 rows/columns m.
  std::optional<Eigen::Vector2d> size = {};
};

/// Returns a grid. The corners of its cells come first, in row-major order (x fastest), then the middles of crossed
/// cells. A shifted row of equilateral triangles also has its two ends, so columns + 2 vertices. Diagonal grids of 2 m
/// × 2 m equal those of make_grid(columns, rows). Texture coordinates go from 0 to 1 along both sides.
/// @throws std::invalid_argument unless columns and rows are at least 1, the vertices can be counted in an int, and the
///   size is positive
Mesh make_grid(const Grid& grid);

}  // namespace drape
