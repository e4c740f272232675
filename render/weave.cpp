#include "render/weave.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace drape {

Weave::Weave(const Vertices& rest, const std::vector<Triangle>& triangles,
             const std::vector<std::array<float, 2>>& uvs) {
  if (uvs.size() != 3 * triangles.size()) return;
  // Mean length of a unit of each coordinate, weighted by the triangles' areas.
  Eigen::Vector2d lengths = Eigen::Vector2d::Zero();
  double area = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    Eigen::Matrix<double, 3, 2> edges;
    Eigen::Matrix2d across;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      edges.col(column) = (rest.row(triangles[t][k + 1]) - rest.row(triangles[t][0])).transpose();
      for (std::size_t axis = 0; axis < 2; ++axis) {
        across(static_cast<Eigen::Index>(axis), column) = uvs[3 * t + k + 1][axis] - uvs[3 * t][axis];
      }
    }
    const Eigen::Vector3d e = edges.col(0), f = edges.col(1);
    const double here = e.cross(f).norm();
    if (!(here > 0) || across.determinant() == 0) continue;
    lengths += here * (edges * across.inverse()).colwise().norm().transpose();
    area += here;
  }
  if (area > 0) yarns_ = (lengths / (area * yarn_width)).cast<float>();
}

bool Weave::visible(const Shot& shot, int height) const {
  if (yarns_.isZero()) return false;
  constexpr double slack = 0.5;  // for cloth between the vertices, and for stretched yarns
  // The projection's rows scale a unit vector: the second to half the picture's height at a depth of 1.
  const Eigen::Matrix4d projection = shot.view_projection.cast<double>();
  const double pixels = projection.block<1, 3>(1, 0).norm() * height / 2;  // per metre at a depth of 1 m
  const double farthest = pixels * yarn_width / (slack * least_pixels);
  const Eigen::RowVector3d back = projection.block<1, 3>(3, 0);
  for (const auto x : shot.frame.positions.rowwise()) {
    const double depth = back.dot(x) + projection(3, 3);
    if (depth > 0 && depth < farthest) return true;
  }
  return false;
}

void Weave::set_uniform(const Program& program) const {
  constexpr float depth = 0.7F;  // of the relief
  program.set("weave", Eigen::Vector3f(yarns_.x(), yarns_.y(), depth));
}

}  // namespace drape
