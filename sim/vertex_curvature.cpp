#include "sim/vertex_curvature.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

namespace drape {
namespace {

/// A triangle at an edge.
struct Side {
  int triangle;
  bool forwards;  // true if it runs along the edge from the smaller vertex number to the larger
};

}  // namespace

VertexCurvature::VertexCurvature(int vertex_count, const std::vector<Triangle>& triangles)
    : vertex_count_(vertex_count), triangles_(triangles) {
  std::map<Edge, std::vector<Side>> edges;  // sorted by vertices, for a fixed order of sums
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const int p = triangles[t][c], q = triangles[t][(c + 1) % 3];
      if (p != q) edges[{std::min(p, q), std::max(p, q)}].push_back({static_cast<int>(t), p < q});
    }
  }
  for (const auto& [edge, sides] : edges) {
    if (sides.size() != 2) continue;
    const bool alike = sides[0].forwards != sides[1].forwards;
    hinges_.push_back({edge, {sides[0].triangle, sides[1].triangle}, alike ? 1.0 : -1.0});
  }
}

Eigen::VectorXd VertexCurvature::operator()(const Vertices& positions) const {
  Eigen::VectorXd area = Eigen::VectorXd::Zero(vertex_count_), bent = area;
  Vertices normals(static_cast<Eigen::Index>(triangles_.size()), 3);  // with the length of twice the triangles' areas
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    const Eigen::Vector3d ab = positions.row(b) - positions.row(a), ac = positions.row(c) - positions.row(a);
    const Eigen::Vector3d normal = ab.cross(ac);
    normals.row(static_cast<Eigen::Index>(t)) = normal.transpose();
    for (const int vertex : triangles_[t]) area[vertex] += normal.norm() / 6;
  }
  for (const Hinge& hinge : hinges_) {
    const Eigen::Vector3d first = normals.row(hinge.triangles[0]),
                          second = hinge.turned * normals.row(hinge.triangles[1]);
    const double angle = std::atan2(first.cross(second).norm(), first.dot(second));
    const double length = (positions.row(hinge.edge[1]) - positions.row(hinge.edge[0])).norm();
    for (const int vertex : hinge.edge) bent[vertex] += angle * length / 4;
  }
  return (area.array() > 0).select(bent.array() / area.array().max(1e-300), 0.0);
}

}  // namespace drape
