#include "render/normals.hpp"

#include <Eigen/Geometry>

namespace drape {

Vertices vertex_normals(const Vertices& positions, const std::vector<Triangle>& triangles) {
  Vertices normals = Vertices::Zero(positions.rows(), 3);
  for (const Triangle& t : triangles) {
    const Eigen::RowVector3d a = positions.row(t[0]);
    const Eigen::RowVector3d twice_area = (positions.row(t[1]) - a).cross(positions.row(t[2]) - a);
    for (const int vertex : t) normals.row(vertex) += twice_area;
  }
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    const double length = normals.row(i).norm();
    if (length > 0) {
      normals.row(i) /= length;
    } else {
      normals.row(i) = Eigen::RowVector3d::UnitZ();
    }
  }
  return normals;
}

}  // namespace drape
