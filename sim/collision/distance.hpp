#pragma once

#include <Eigen/Core>
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

}  // namespace drape
