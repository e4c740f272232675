#pragma once

#include <array>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "drape/sim/mesh.hpp"
#include "sim/collision/distance.hpp"

namespace drape {

/// Conservative test that a cloth cut from one flat, convex piece does not touch itself in a step.
///
/// Let J be the gradient of the cloth's shape, projected onto a fixed plane, with respect to the flat shape; J is
/// constant on each triangle. If the symmetric part of J has no eigenvalue below s > 0 anywhere, then
///   (p(a) − p(b))·(a − b) ≥ s ‖a − b‖²
/// along the segment from b to a, which stays in the convex piece. So points at the distance r in the flat shape are at
/// least s·r apart (a strictly monotone map). J is linear in the vertex positions: what holds at both ends of straight
/// paths holds between them.
class MonotoneSheet {
 public:
  /// @param distance at which features touch [m]
  MonotoneSheet(const Cloth& cloth, double distance);

  /// Begins a step with the vertices at `from`, which has to live until the next step begins.
  void begin(const std::vector<Point>& from);

  /// Returns true if no two features without a common vertex come within the distance while the vertices move on
  /// straight lines to `to`. Returns false if unknown.
  [[nodiscard]] bool stays_apart(const std::vector<Point>& to);

 private:
  /// A triangle and the inverse of its edges in the flat shape, row by row [1/m].
  struct FlatTriangle {
    Triangle vertices;
    std::array<double, 4> inverse;
  };

  /// Finds the projection plane from the mean deformation; returns false if it is degenerate.
  bool choose_plane(const std::vector<Point>& x);
  [[nodiscard]] bool is_monotone(const std::vector<Point>& x);
  /// Tests the start of the step, in a plane of its own.
  void test_start() { starts_apart_ = !triangles_.empty() && choose_plane(*from_) && is_monotone(*from_); }

  std::vector<FlatTriangle> triangles_;         // empty if the cloth is not flat and convex
  std::vector<std::array<double, 2>> weights_;  // of the vertices in the integral of the gradient
  double least_ = 0;                            // required eigenvalue
  const std::vector<Point>* from_ = nullptr;    // start of the step
  bool starts_apart_ = false;                   // at the start of the step
  bool earlier_plane_ = false;                  // the plane is that of an earlier step
  std::vector<Point> apart_at_;                 // end of the last path known to be apart, in the present plane
  Point first_, second_;                        // axes of the projection
  std::vector<std::array<double, 2>> projected_;
};

/// A triangle with those of its vertices and edges that no earlier triangle owns. So a search by triangles finds each
/// feature once (Curtis, Tamstorf and Manocha 2008, "Fast collision detection for deformable models using
/// representative-triangles").
struct Patch {
  Triangle corners;
  std::array<bool, 3> own_vertex, own_edge;  ///< edge c leads from corner c to c + 1
};

/// Returns the patches of a mesh, in the order of its triangles.
/// @param first number of the mesh's first vertex
std::vector<Patch> make_patches(const std::vector<Triangle>& triangles, int first, int vertex_count);

}  // namespace drape
