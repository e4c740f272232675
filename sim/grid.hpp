#pragma once

// Example:
//   const drape::Mesh mesh = drape::make_grid({.columns = 30, .rows = 20, .size = {{1.5, 1}}});

#include <optional>

#include "sim/mesh.hpp"

namespace drape {

/// How a grid's cells are divided into triangles.
enum class GridPattern {
  diagonal,     ///< by one diagonal, the same in every cell
  alternating,  ///< by the one diagonal and the other, as the colours of a chessboard
  x,            ///< by both, with a vertex in the middle
  equilateral   ///< rows of triangles, every other row moved by half a cell
};

/// A rectangle of cells in the plane of x and y, around the origin.
struct Grid {
  int columns = 1, rows = 1;
  GridPattern pattern = GridPattern::diagonal;
  /// Along x and y [m]. Default: 2 m × 2 m; of equilateral triangles 2 m × √3 rows/columns m.
  std::optional<Eigen::Vector2d> size = {};
};

/// Makes a grid. The corners of its cells come first, in row-major order (x fastest), then the middles of crossed
/// cells. A row of equilateral triangles that is moved has its two ends besides, so columns + 2 vertices. Diagonal
/// grids of 2 m × 2 m are those of make_grid(columns, rows). Texture coordinates go from 0 to 1 along both sides.
/// @throws std::invalid_argument unless columns and rows are at least 1, the vertices can be counted in an int, and the
///   size is positive
Mesh make_grid(const Grid& grid);

}  // namespace drape
