#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "drape/sim/mesh.hpp"

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

/// Returns the n×3 unit normals of the vertices. Each sums its triangles' normals, weighted by area, in the order of
/// the triangles; flattened triangles have no weight. A vertex without a normal gets +z.
Vertices vertex_normals(const Vertices& positions, const std::vector<Triangle>& triangles);

/// Normalises a vector, even if its squared length overflows or underflows.
inline Eigen::Vector3d unit_vector(const Eigen::Vector3d& v) {
  return std::isnormal(v.squaredNorm()) ? v.normalized() : v.stableNormalized();
}

/// The rounded rim of a cloth: half a tube along its border edges, which have one triangle. It makes the cloth's
/// thickness visible.
class Hem {
 public:
  static constexpr double least_pixels = 1.5;  ///< thickness in a picture below which the hem is not drawn

  /// The corner of a piece that a vertex of the tube belongs to.
  struct Corner {
    int piece;
    std::size_t corner;
  };

  /// @param surface surface to hem; its vertices precede the hem's
  /// @param thickness thickness of the cloth [m]; 0: no hem
  Hem(const SmoothSurface& surface, double thickness);

  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Returns triangles, not to be drawn, that join the tube to the pieces at its front and back: with them, the tube's
  /// edges tell on which side the cloth lies.
  [[nodiscard]] const std::vector<Triangle>& joints() const { return joints_; }
  /// Returns the adjacent piece of each triangle.
  [[nodiscard]] const std::vector<int>& pieces() const { return pieces_; }
  [[nodiscard]] const std::vector<Corner>& corners() const { return corners_; }

  /// Appends the hem's vertices and the normals of its tube.
  /// @param positions,normals positions and normals of the surface's vertices
  void append(Vertices& positions, Vertices& normals) const;

 private:
  static constexpr int ring = 3;  // vertices around half a tube

  /// A vertex of the border and its neighbours there, ordered with the cloth on the left.
  struct BorderVertex {
    int vertex, before, after;
  };

  double thickness_;
  std::vector<BorderVertex> border_;
  std::vector<Triangle> triangles_, joints_;
  std::vector<int> pieces_;
  std::vector<Corner> corners_;  // per vertex of the hem
};

}  // namespace drape
