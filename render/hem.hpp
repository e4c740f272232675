#pragma once

#include <array>
#include <vector>

#include "render/smooth_surface.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// The rounded rim of a cloth: half a tube along its border edges, which have one triangle. It makes the cloth's
/// thickness visible.
class Hem {
 public:
  /// The corner of a piece that a vertex of the tube belongs to.
  struct Corner {
    int piece;
    std::size_t corner;
  };

  /// @param surface surface to hem; its vertices precede the hem's
  /// @param thickness thickness of the cloth [m]; 0: no hem
  Hem(const SmoothSurface& surface, double thickness);

  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
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
  std::vector<Triangle> triangles_;
  std::vector<int> pieces_;
  std::vector<Corner> corners_;  // per vertex of the hem
};

}  // namespace drape
