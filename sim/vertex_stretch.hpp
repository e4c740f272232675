#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// Stretch of a cloth at each vertex: the largest principal stretch of the triangles around it, averaged by their rest
/// areas. That is the largest singular value of the deformation gradient F (1: at rest). A cloth stretched by s in one
/// direction only has s everywhere, on any mesh.
class VertexStretch {
 public:
  /// @param rest      n×3, unstrained shape [m]
  /// @param triangles of the cloth; those without a rest area are ignored
  VertexStretch(const Vertices& rest, const std::vector<Triangle>& triangles);

  /// Returns the stretch.
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
  Eigen::VectorXd areas_;  // sum over the triangles around each vertex [m²]
};

}  // namespace drape
