#include "sim/flipped_pairs.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "sim/bending/hinges.hpp"

namespace drape {
namespace {

constexpr double cosine_of_150_degrees = -0.86602540378443865;

Eigen::Vector3d unit_normal(const Triangle& t, const Vertices& x) {
  const Eigen::Vector3d a = x.row(t[0]), b = x.row(t[1]), c = x.row(t[2]);
  return (b - a).cross(c - a).normalized();  // stays zero without area
}

}  // namespace

FlippedPairs::FlippedPairs(const std::vector<Triangle>& triangles) : triangles_(triangles) {
  const std::vector<EdgeSide> sides = edge_sides(triangles);
  for (std::size_t s = 1; s < sides.size(); ++s) {
    if (sides[s].edge == sides[s - 1].edge) neighbours_.push_back({sides[s - 1].triangle, sides[s].triangle});
  }
}

int FlippedPairs::count(const Vertices& x) const {
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(triangles_.size());
  for (const Triangle& triangle : triangles_) normals.push_back(unit_normal(triangle, x));
  return static_cast<int>(std::count_if(neighbours_.begin(), neighbours_.end(), [&](const std::array<int, 2>& pair) {
    return normals[static_cast<std::size_t>(pair[0])].dot(normals[static_cast<std::size_t>(pair[1])]) <
           cosine_of_150_degrees;
  }));
}

}  // namespace drape
