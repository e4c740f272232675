#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// The edge between two vertices, the lower number first.
inline Edge undirected(int p, int q) { return {std::min(p, q), std::max(p, q)}; }

/// The limit surface of Loop's subdivision (1987) of a cloth's mesh, sampled finely enough for a picture. A position of
/// it is a weighted mean of the cloth's vertices nearby, with weights that depend on the triangles alone. Edges of one
/// triangle, or of more than two, become cubic B-splines of their own (Hoppe et al. 1994), which end at the corners of
/// the cloth.
///
/// A flat grid keeps its shape and corners keep their place. The control points are moved outwards first, by as much as
/// the surface would be inside them: on a ball it then differs from its vertices by a fourth power of an edge's length,
/// far less than the distance that contact keeps.
class SmoothSurface {
 public:
  /// A triangle of the surface, which is part of one of the mesh.
  struct Piece {
    Triangle corners;                             ///< numbers of the surface's vertices
    int parent;                                   ///< the mesh's triangle
    std::array<std::array<float, 3>, 3> weights;  ///< barycentric coordinates of each corner in the parent
  };

  /// @param levels how often each triangle is divided into four; 0 leaves the mesh as it is
  SmoothSurface(const std::vector<Triangle>& triangles, int levels);

  /// The number of levels for a picture of so many pixels: an edge takes a few of them.
  static int levels_for(std::size_t triangle_count, double pixels);

  [[nodiscard]] int vertex_count() const { return vertex_count_; }
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }

  /// The surface's vertices, of those of the mesh.
  [[nodiscard]] Vertices positions(const Vertices& vertices) const;

 private:
  void divide();
  void project_to_limit();

  std::vector<Piece> pieces_;
  std::vector<Triangle> triangles_;  // of the pieces
  int vertex_count_ = 0;
  bool divided_ = false;
  Eigen::SparseMatrix<double, Eigen::RowMajor> weights_;  // of the surface's vertices
  Eigen::SparseMatrix<double, Eigen::RowMajor> limits_;   // of the first of them, which the mesh's own become
};

}  // namespace drape
