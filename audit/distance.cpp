#include "audit/distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace drape::audit {

double square_distance(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const bool above = (b - a).cross(p - a).dot(normal) >= 0 && (c - b).cross(p - b).dot(normal) >= 0 &&
                     (a - c).cross(p - c).dot(normal) >= 0;
  if (above && normal.squaredNorm() > 0) return std::pow(normal.dot(p - a), 2) / normal.squaredNorm();
  double square = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d &from = triangle[i], along = triangle[(i + 1) % 3] - from;
    const double length = along.squaredNorm();
    const double s = length > 0 ? std::clamp((p - from).dot(along) / length, 0.0, 1.0) : 0;
    square = std::min(square, (from + s * along - p).squaredNorm());
  }
  return square;
}

}  // namespace drape::audit
