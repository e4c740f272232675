#pragma once

#include <array>
#include <vector>

#include "sim/cloth.hpp"

namespace drape {

/// A triangle of the rest shape, laid into a plane.
struct PlacedTriangle {
  int triangle;
  std::array<Eigen::Vector2d, 3> corners;  ///< [m]
};

/// The triangles of a cloth's rest shape, and what lies beyond their sides. Side k of a triangle goes from its corner k
/// to the next one.
class RestSurface {
 public:
  /// What is beyond a side: a triangle and its vertex opposite to that side, both −1 where there is none. Around an
  /// edge of three triangles or more, it is the next one.
  struct Beyond {
    int triangle = -1, opposite = -1;
  };

  /// Refers to the cloth, which must outlive it.
  explicit RestSurface(const Cloth& cloth);

  [[nodiscard]] int triangle_count() const { return static_cast<int>(held_.size()); }
  [[nodiscard]] const Triangle& triangle(int t) const { return cloth_.triangles[static_cast<std::size_t>(t)]; }
  [[nodiscard]] Eigen::Vector3d place(int vertex) const { return cloth_.rest.row(vertex).transpose(); }
  [[nodiscard]] const Beyond& beyond(int t, int side) const {
    return beyond_[3 * static_cast<std::size_t>(t) + static_cast<std::size_t>(side)];
  }
  /// Whether all its vertices are pinned.
  [[nodiscard]] bool held(int t) const { return held_[static_cast<std::size_t>(t)]; }
  /// Whether a triangle is free and something lies beyond one of its sides.
  [[nodiscard]] bool bends(int t) const;

  /// Corner 0 lies at the origin, corner 1 on the positive x axis, corner 2 above it.
  [[nodiscard]] PlacedTriangle lay_out(int t) const;
  /// The triangle beyond a side, turned around that side into the plane of `from`.
  [[nodiscard]] PlacedTriangle unfold(const PlacedTriangle& from, int side) const;

 private:
  const Cloth& cloth_;
  std::vector<Beyond> beyond_;
  std::vector<bool> held_;
};

/// The unit normal of a side, out of the triangle.
Eigen::Vector2d outward(const PlacedTriangle& t, int side);

}  // namespace drape
