#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace drape {

using Point = Eigen::Vector3d;
using FourPoints = std::array<Point, 4>;

/// Two features of a mesh that can touch, as four points: a vertex and the three corners of a triangle, or the two ends
/// of an edge and the two ends of another.
enum class Feature { vertex_triangle, edge_edge };

/// The nearest points of two features: their difference is Σ weights[i]·p[i], from the second to the first, and the
/// weights of each feature sum to 1 and to −1.
struct Nearest {
  double squared;  ///< of the distance [m²]
  std::array<double, 4> weights;

  [[nodiscard]] Point difference(const FourPoints& p) const {
    return weights[0] * p[0] + weights[1] * p[1] + weights[2] * p[2] + weights[3] * p[3];
  }
};

/// For every position, degenerate ones included: a triangle without an area is the edges it consists of, an edge
/// without a length a point. Of several nearest points of parallel edges it is any. (Ericson 2005, "Real-Time Collision
/// Detection", sections 5.1.5 and 5.1.9.)
Nearest nearest(Feature feature, const FourPoints& p);

/// Whether a plane across an axis lies between two features, further than the distance [m] from both together, the
/// first above it. The axis counts with its length.
inline bool separated(Feature feature, const Point& axis, const FourPoints& p, double distance) {
  const double a = axis.dot(p[0]), b = axis.dot(p[1]), c = axis.dot(p[2]), d = axis.dot(p[3]);
  const double gap = feature == Feature::vertex_triangle ? a - std::max({b, c, d}) : std::min(a, b) - std::max(c, d);
  return gap > distance;
}

/// Whether two features stay further apart than `reach` [m] while their points go on straight lines, as far as a plane
/// across an axis shows it: a distance along that changes linearly, so what is apart at both ends is so in between.
inline bool kept_apart(Feature feature, const Point& axis, const FourPoints& from, const FourPoints& to, double reach) {
  const double far = reach * axis.norm();
  return separated(feature, axis, from, far) && separated(feature, axis, to, far);
}

/// The same of a plane between their middles.
inline bool kept_apart(Feature feature, const FourPoints& from, const FourPoints& to, double reach) {
  const Point axis = feature == Feature::vertex_triangle ? Point(from[0] - (from[1] + from[2] + from[3]) / 3)
                                                         : Point((from[0] + from[1] - from[2] - from[3]) / 2);
  return kept_apart(feature, axis, from, to, reach);
}

}  // namespace drape
