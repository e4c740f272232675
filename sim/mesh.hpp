#pragma once

// Example:
//   drape::Mesh triangle;
//   triangle.positions.resize(3, 3);
//   triangle.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0;  // a row for each vertex
//   triangle.triangles = {{0, 1, 2}};

#include <Eigen/Core>
#include <array>
#include <vector>

namespace drape {

/// n×3, column-major: all x, then all y, then all z. Positions in m, velocities in m/s, forces in N.
using Vertices = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Vertices of a triangle, counterclockwise seen from its front.
using Triangle = std::array<int, 3>;

/// Vertices of an edge, the smaller number first.
using Edge = std::array<int, 2>;

/// A triangle mesh. May have several pieces, boundary and non-manifold edges, and isolated vertices.
struct Mesh {
  Vertices positions = {};               ///< n×3 [m]
  std::vector<Triangle> triangles = {};  ///< indices below n
  /// Texture coordinates, v upwards: entry 3t+c is corner c of triangle t; empty if none.
  std::vector<std::array<float, 2>> uvs = {};
};

/// Returns the square [-1,1]² at z = 0 with columns×rows cells and (columns+1)·(rows+1) vertices in row-major order (x
/// fastest). Each cell has two triangles, (b,d,a) and (b,e,d) with a = (i,j), b = (i+1,j), d = (i,j+1), e = (i+1,j+1).
/// All (b,d,a) come first in row-major order, then all (b,e,d). Texture coordinates are ((x+1)/2, (y+1)/2).
/// @throws std::invalid_argument unless columns and rows are at least 1 and the vertices can be counted in an int
Mesh make_grid(int columns, int rows);

/// Returns every edge once, sorted. Degenerate sides (twice the same vertex) give no edge.
std::vector<Edge> unique_edges(const std::vector<Triangle>& triangles);

}  // namespace drape
