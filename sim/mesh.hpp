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

/// A triangle's three vertices, counterclockwise seen from its front.
using Triangle = std::array<int, 3>;

/// An edge's two vertices, the smaller number first.
using Edge = std::array<int, 2>;

/// A triangle mesh. Several pieces, boundary and non-manifold edges, and isolated vertices are allowed.
struct Mesh {
  Vertices positions = {};                     ///< n×3 [m]
  std::vector<Triangle> triangles = {};        ///< indices below n
  std::vector<std::array<float, 2>> uvs = {};  ///< texture coordinates, v upwards: entry 3t+c is corner c of triangle
                                               ///< t; empty where the mesh has none
};

/// The square [-1,1]² at z = 0 with columns×rows cells, (columns+1)·(rows+1) vertices in row-major order (x fastest),
/// and two triangles per cell, (b,d,a) and (b,e,d) with a = (i,j), b = (i+1,j), d = (i,j+1), e = (i+1,j+1): first the
/// (b,d,a) of all cells in row-major order, then the (b,e,d). Texture coordinates are ((x+1)/2, (y+1)/2).
/// @throws std::invalid_argument unless columns and rows are at least 1 and the vertices can be counted in an int
Mesh make_grid(int columns, int rows);

/// Every edge of every triangle once, sorted. Degenerate corners (twice the same vertex) give no edge.
std::vector<Edge> unique_edges(const std::vector<Triangle>& triangles);

}  // namespace drape
