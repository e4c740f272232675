#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// The edge between two vertices, the lower number first.
inline Edge undirected(int p, int q) { return {std::min(p, q), std::max(p, q)}; }

/// The limit surface of Loop's subdivision (1987) of a cloth's mesh, sampled finely enough for a picture. Each position
/// is a weighted mean of nearby vertices; the weights depend only on the triangles. Edges with one triangle, or more
/// than two, become separate cubic B-splines (Hoppe et al. 1994) that end at the corners of the cloth.
///
/// A flat grid keeps its shape and corners keep their place. Control points first move outwards by the distance that
/// the surface would lie inside them. On a ball the surface then differs from its vertices by a fourth power of the
/// edge length, far less than the contact distance.
class SmoothSurface {
 public:
  /// A triangle of the surface, part of a triangle of the mesh.
  struct Piece {
    Triangle corners;                             ///< numbers of the surface's vertices
    int parent;                                   ///< the mesh's triangle
    std::array<std::array<float, 3>, 3> weights;  ///< barycentric coordinates of each corner in the parent
  };

  /// @param levels number of divisions of each triangle into four; 0 keeps the mesh
  SmoothSurface(const std::vector<Triangle>& triangles, int levels);

  /// Returns the number of levels for a picture of so many pixels: an edge gets a few of them.
  static int levels_for(std::size_t triangle_count, double pixels);

  [[nodiscard]] int vertex_count() const { return vertex_count_; }
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }

  /// Computes the surface's vertices from those of the mesh.
  [[nodiscard]] Vertices positions(const Vertices& vertices) const;

 private:
  void divide();
  void project_to_limit();

  std::vector<Piece> pieces_;
  std::vector<Triangle> triangles_;  // triangles of the pieces
  int vertex_count_ = 0;
  bool divided_ = false;
  Eigen::SparseMatrix<double, Eigen::RowMajor> weights_;  // weights of the surface's vertices
  Eigen::SparseMatrix<double, Eigen::RowMajor> limits_;   // limit weights of its first vertices, those of the mesh
};

}  // namespace drape
