#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// How sharply a cloth is bent at each of its vertices [1/m]: (|κ₁| + |κ₂|)/2 of the principal curvatures, 1/(2R) on a
/// cylinder and 1/R on a sphere of radius R, 0 where it is flat or ends. An edge between two triangles that are turned
/// against each other by θ has ½θ times its length of it (the integral of the mean curvature of an edge that is rounded
/// off, Cohen-Steiner and Morvan 2003), which its two vertices share; a vertex has the area of a third of its
/// triangles.
class VertexCurvature {
 public:
  /// @param vertex_count of the cloth
  /// @param triangles    of it; edges of more than two are left out
  VertexCurvature(int vertex_count, const std::vector<Triangle>& triangles);

  /// @param positions n×3 [m]
  /// @returns n; 0 at vertices without an area
  [[nodiscard]] Eigen::VectorXd operator()(const Vertices& positions) const;

 private:
  struct Hinge {
    Edge edge;
    std::array<int, 2> triangles;  // at its sides
    double turned;                 // -1 where they are wound against each other, else 1
  };
  int vertex_count_;
  std::vector<Triangle> triangles_;
  std::vector<Hinge> hinges_;
};

}  // namespace drape
