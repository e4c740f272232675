#pragma once

// Example:
//   drape::MeshMotion lift{.mesh = drape::make_grid(1, 1)};
//   lift.times = {0, 2};
//   lift.samples = {lift.mesh.positions, lift.mesh.positions.array() + 1};
//   drape::Vertices points(1, 3);
//   points << 0.5, -0.5, 0.1;  // a tenth of a metre above the square
//   const drape::MeshAnchors anchors(lift, points, 0);
//   const Eigen::Vector3d there = anchors.at(0, 2).position;  // (1.5, 0.5, 1.1)

#include <Eigen/Core>
#include <vector>

#include "sim/mesh_motion.hpp"

namespace drape {

/// Points that hold on to a moving mesh: each to the point of its surface that was nearest at first, and to its place
/// beside it, which turns with the triangle. The triangle's frame has its first axis along the edge from its first to
/// its second corner and its third along the normal; the axes are orthonormal, so a triangle that is stretched takes
/// its point along, but not farther away.
class MeshAnchors {
 public:
  /// @param points n×3 [m]
  /// @param time   at which they are attached [s]
  /// @throws std::invalid_argument if the mesh has no triangle with an area then
  MeshAnchors(const MeshMotion& motion, const Vertices& points, double time);

  /// Where a point is and how it moves.
  struct Place {
    Eigen::Vector3d position;  ///< [m]
    Eigen::Vector3d velocity;  ///< where it jumps, as it was before [m/s]
  };

  /// The `k`-th point at a time [s].
  [[nodiscard]] Place at(std::size_t k, double time) const;

 private:
  struct Anchor {
    Triangle corners;         // rows of the samples here
    Eigen::Vector3d weights;  // of the corners: barycentric coordinates of the surface's point
    Eigen::Vector3d offset;   // from there, in the triangle's frame [m]
  };
  void attach(const Vertices& at_first, const std::vector<Triangle>& triangles, const Vertices& points);

  std::vector<Anchor> anchors_;
  std::vector<double> times_;      // at least one
  std::vector<Vertices> samples_;  // of the vertices of the triangles that hold something
};

}  // namespace drape
