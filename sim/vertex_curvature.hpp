#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// Curvature of a cloth at each vertex [1/m]: (|κ₁| + |κ₂|)/2 of the principal curvatures. It is 1/(2R) on a cylinder
/// and 1/R on a sphere of radius R, and 0 in flat parts and at borders. An edge whose triangles meet at the angle θ
/// contributes ½θ times its length, shared by its two vertices. This is the integral of the mean curvature over a
/// rounded edge (Cohen-Steiner and Morvan 2003). A vertex has the area of a third of its triangles.
class VertexCurvature {
 public:
  /// @param vertex_count of the cloth
  /// @param triangles    of the cloth; edges of more than two triangles are omitted
  VertexCurvature(int vertex_count, const std::vector<Triangle>& triangles);

  /// Returns the curvature.
  /// @param positions n×3 [m]
  /// @returns n; 0 at vertices without an area
  [[nodiscard]] Eigen::VectorXd operator()(const Vertices& positions) const;

 private:
  struct Hinge {
    Edge edge;
    std::array<int, 2> triangles;  // on both sides
    double turned;                 // -1 if they have opposite orientations, else 1
  };
  int vertex_count_;
  std::vector<Triangle> triangles_;
  std::vector<Hinge> hinges_;
};

}  // namespace drape
