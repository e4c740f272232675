#include "sim/vertex_stretch.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

namespace drape {
namespace {

using Edges = Eigen::Matrix<double, 3, 2>;

/// Returns the edges from a triangle's first vertex to its second and third.
Edges edges_of(const Vertices& x, const Triangle& t) {
  Edges edges;
  edges << (x.row(t[1]) - x.row(t[0])).transpose(), (x.row(t[2]) - x.row(t[0])).transpose();
  return edges;
}

/// Returns the larger singular value, from the closed form of the eigenvalues of FᵀF.
double largest_singular_value(const Edges& f) {
  const double a = f.col(0).squaredNorm(), b = f.col(0).dot(f.col(1)), d = f.col(1).squaredNorm();
  return std::sqrt((a + d) / 2 + std::hypot((a - d) / 2, b));
}

}  // namespace

VertexStretch::VertexStretch(const Vertices& rest, const std::vector<Triangle>& triangles)
    : areas_(Eigen::VectorXd::Zero(rest.rows())) {
  for (const Triangle& triangle : triangles) {
    const Edges edges = edges_of(rest, triangle);
    const double area = edges.col(0).cross(edges.col(1)).norm() / 2;
    if (!(area > 0)) continue;
    // Place the triangle in its own plane, with its first edge along x.
    const Eigen::Vector3d x = edges.col(0).normalized();
    Eigen::Matrix2d flat;
    flat << edges.col(0).norm(), x.dot(edges.col(1)), 0, 2 * area / edges.col(0).norm();
    elements_.push_back({triangle, flat.inverse(), area});
    for (const int vertex : triangle) areas_[vertex] += area;
  }
}

Eigen::VectorXd VertexStretch::operator()(const Vertices& positions) const {
  Eigen::VectorXd stretch = Eigen::VectorXd::Zero(areas_.size());
  for (const Element& element : elements_) {
    const double largest = largest_singular_value(edges_of(positions, element.triangle) * element.to_rest);
    for (const int vertex : element.triangle) stretch[vertex] += element.area * largest;
  }
  return (areas_.array() > 0).select(stretch.array() / areas_.array().max(1e-300), 1.0);
}

}  // namespace drape
