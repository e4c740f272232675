#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "drape/sim/mesh.hpp"

namespace drape {

using Point = Eigen::Vector3d;
using FourPoints = std::array<Point, 4>;

/// Pair of mesh features that can touch, as four points: a vertex and the corners of a triangle, or the ends of two
/// edges.
enum class Feature { vertex_triangle, edge_edge };

/// Closest points of two features. Their difference, from the second to the first, is Σ weights[i]·p[i]; the weights
/// sum to 1 over the first feature and to −1 over the second.
struct Nearest {
  double squared;  ///< squared distance [m²]
  std::array<double, 4> weights;

  [[nodiscard]] Point difference(const FourPoints& p) const {
    return weights[0] * p[0] + weights[1] * p[1] + weights[2] * p[2] + weights[3] * p[3];
  }
};

/// Returns the closest points in any position. A triangle without area counts as its edges, an edge without length as a
/// point. Parallel edges may have several solutions; any is returned. (Ericson 2005, "Real-Time Collision Detection",
/// sections 5.1.5 and 5.1.9.)
Nearest nearest(Feature feature, const FourPoints& p);

/// Returns true if a slab wider than the distance [m], across the axis, separates two features with the first above.
/// The distance is scaled by the length of the axis.
inline bool separated(Feature feature, const Point& axis, const FourPoints& p, double distance) {
  const double a = axis.dot(p[0]), b = axis.dot(p[1]), c = axis.dot(p[2]), d = axis.dot(p[3]);
  const double gap = feature == Feature::vertex_triangle ? a - std::max({b, c, d}) : std::min(a, b) - std::max(c, d);
  return gap > distance;
}

/// Returns true if a slab across an axis keeps two features further apart than `reach` [m] on straight paths. Distances
/// along the axis change linearly, so separation at both ends holds in between.
inline bool kept_apart(Feature feature, const Point& axis, const FourPoints& from, const FourPoints& to, double reach) {
  const double far = reach * axis.norm();
  return separated(feature, axis, from, far) && separated(feature, axis, to, far);
}

/// Tests the axis through the centres of both features.
inline bool kept_apart(Feature feature, const FourPoints& from, const FourPoints& to, double reach) {
  const Point axis = feature == Feature::vertex_triangle ? Point(from[0] - (from[1] + from[2] + from[3]) / 3)
                                                         : Point((from[0] + from[1] - from[2] - from[3]) / 2);
  return kept_apart(feature, axis, from, to, reach);
}

/// Fraction of their initial distance at which two features count as colliding.
inline constexpr double kept_gap = 0.1;

/// Returns the first time at which two features, moving as p + t·move for t in [0, 1], approach to about `kept_gap`
/// times their distance at t = 0. They are never nearer before. Returns nothing if they stay further apart.
/// Detects every collision for any motion: it advances by steps too short for a contact within them (Li, Kaufman and
/// Jiang 2021, "Codimensional incremental potential contact", section 5.2). Unlike with roots of a cubic, coplanar,
/// parallel and degenerate features need no special cases. Features that touch at t = 0 do not collide, as their side
/// is undefined.
/// @param widest upper limit of the gap [m]
std::optional<double> time_of_impact(Feature feature, FourPoints p, FourPoints move,
                                     double widest = std::numeric_limits<double>::infinity());

/// An edge that passes through a triangle with which it shares no vertex.
struct Intersection {
  Edge edge;
  std::size_t triangle;  ///< its number
};

/// Finds every edge that passes through a triangle, sorted by edges and then by triangles. An edge in a triangle's
/// plane does not pass through it, even if rounding moved vertices out of the plane, as when a flat cloth is turned.
/// Nearly linear in the size of the meshes.
std::vector<Intersection> find_intersections(const std::vector<Edge>& edges, const std::vector<Triangle>& triangles,
                                             const std::vector<Point>& points);

/// Finds the edges through which a surface passes a triangle exactly at a vertex, where find_intersections() sees no
/// edge on both sides. The edges at a vertex on a triangle pass through wherever they are displaced a little; a surface
/// that only touches is free in some direction.
std::vector<Intersection> find_intersections_at_vertices(const std::vector<Edge>& edges,
                                                         const std::vector<Triangle>& triangles,
                                                         const std::vector<Point>& points);

}  // namespace drape
