#pragma once

#include <array>
#include <vector>

#include "render/smooth_surface.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// The rounded rim of a cloth: half a tube along the edges that only one triangle has. It shows that cloth has a
/// thickness, where a surface without one would end in nothing.
class Hem {
 public:
  /// A vertex of the tube belongs to a corner of a piece.
  struct Corner {
    int piece;
    std::size_t corner;
  };

  /// @param surface of which the hem is; its vertices come before those of the hem
  /// @param thickness of the cloth [m]; 0: no hem
  Hem(const SmoothSurface& surface, double thickness);

  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  /// The piece that each triangle lies at.
  [[nodiscard]] const std::vector<int>& pieces() const { return pieces_; }
  [[nodiscard]] const std::vector<Corner>& corners() const { return corners_; }

  /// Appends the vertices of the hem, and the normals of its tube.
  /// @param positions,normals of the surface's vertices
  void append(Vertices& positions, Vertices& normals) const;

 private:
  static constexpr int ring = 3;  // vertices around half a tube

  /// A vertex at the border, and the ends of its edges there, in the direction that has the cloth on its left.
  struct BorderVertex {
    int vertex, before, after;
  };

  double thickness_;
  std::vector<BorderVertex> border_;
  std::vector<Triangle> triangles_;
  std::vector<int> pieces_;
  std::vector<Corner> corners_;  // of each vertex of the hem
};

}  // namespace drape
