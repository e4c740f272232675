#pragma once

#include <array>
#include <vector>

#include "sim/cloth.hpp"

namespace drape {

/// A triangle of the rest shape, laid out in a plane.
struct PlacedTriangle {
  int triangle;
  std::array<Eigen::Vector2d, 3> corners;  ///< [m]
};

/// Triangles of a cloth's rest shape, and their neighbours. Side k of a triangle leads from its corner k to the next.
class RestSurface {
 public:
  /// Neighbour across a side: a triangle and its vertex opposite to that side, or −1 for both. At an edge of three or
  /// more triangles it is the next one.
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
  /// Returns true if all its vertices are pinned.
  [[nodiscard]] bool held(int t) const { return held_[static_cast<std::size_t>(t)]; }
  /// Returns true if a triangle is free and has a neighbour.
  [[nodiscard]] bool bends(int t) const;

  /// Returns the triangle with corner 0 at the origin, corner 1 on the positive x axis, and corner 2 above it.
  [[nodiscard]] PlacedTriangle lay_out(int t) const;
  /// Returns the neighbour across a side, rotated around that side into the plane of `from`.
  [[nodiscard]] PlacedTriangle unfold(const PlacedTriangle& from, int side) const;

 private:
  const Cloth& cloth_;
  std::vector<Beyond> beyond_;
  std::vector<bool> held_;
};

/// Returns the outward unit normal of a side.
Eigen::Vector2d outward(const PlacedTriangle& t, int side);

}  // namespace drape
