#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// How far a cloth is stretched at each of its vertices: the largest principal stretch of the triangles around it, that
/// is the largest singular value of their deformation gradient F (1: as at rest), averaged by their areas at rest. A
/// cloth that is stretched by s in any one direction, and not in the other, has s everywhere, however it is meshed.
class VertexStretch {
 public:
  /// @param rest      n×3, the shape without strain [m]
  /// @param triangles of it; those without an area at rest say nothing
  VertexStretch(const Vertices& rest, const std::vector<Triangle>& triangles);

  /// @param positions n×3 [m]
  /// @returns n; 1 at vertices without a triangle
  [[nodiscard]] Eigen::VectorXd operator()(const Vertices& positions) const;

 private:
  struct Element {
    Triangle triangle;
    Eigen::Matrix2d to_rest;  // F = (edges in space)·to_rest
    double area;              // at rest [m²]
  };
  std::vector<Element> elements_;
  Eigen::VectorXd areas_;  // of the triangles around each vertex
};

}  // namespace drape
