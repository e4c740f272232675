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

#include "drape/sim/body_shape.hpp"

namespace drape {

/// Points attached to a moving mesh. Each keeps its offset from the point of the surface that was closest at first, and
/// the offset turns with the triangle. The triangle's frame is orthonormal: the first axis is along the edge from its
/// first to its second corner, the third along the normal. So a stretched triangle moves its point but does not change
/// the distance.
class MeshAnchors {
 public:
  /// @param points n×3 [m]
  /// @param time   of attachment [s]
  /// @throws std::invalid_argument if no triangle of the mesh has an area then
  MeshAnchors(const MeshMotion& motion, const Vertices& points, double time);

  /// Position and velocity of a point.
  struct Place {
    Eigen::Vector3d position;  ///< [m]
    Eigen::Vector3d velocity;  ///< at a jump, the one before [m/s]
  };

  /// Returns the `k`-th point at a time [s].
  [[nodiscard]] Place at(std::size_t k, double time) const;

 private:
  struct Anchor {
    Triangle corners;         // rows of samples_
    Eigen::Vector3d weights;  // barycentric coordinates of the surface point
    Eigen::Vector3d offset;   // offset from the surface point, in the triangle's frame [m]
  };
  void attach(const Vertices& at_first, const std::vector<Triangle>& triangles, const Vertices& points);

  std::vector<Anchor> anchors_;
  std::vector<double> times_;      // at least one
  std::vector<Vertices> samples_;  // positions of the vertices of triangles with an anchor
};

}  // namespace drape
