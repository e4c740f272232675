#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "sim/cloth.hpp"
#include "sim/collision/distance.hpp"
#include "sim/collision/spatial_hash.hpp"
#include "sim/parallel/part_lists.hpp"

namespace drape {

/// Two features of a cloth that share no vertex and may touch in a step.
struct FeaturePair {
  Feature feature;
  std::array<int, 4> vertices;  ///< as in FourPoints

  auto operator<=>(const FeaturePair&) const = default;  // NOLINT(modernize-use-nullptr): it takes <=> for a 0
};

/// The four points of a pair.
inline FourPoints gather(const std::vector<Point>& points, const std::array<int, 4>& v) {
  return {points[static_cast<std::size_t>(v[0])], points[static_cast<std::size_t>(v[1])],
          points[static_cast<std::size_t>(v[2])], points[static_cast<std::size_t>(v[3])]};
}

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

/// Whether two features may come nearer than `reach` [m] while their points go on straight lines; never misses any that
/// do.
bool may_come_near(Feature feature, const FourPoints& from, FourPoints to, double reach);

/// Finds the pairs of features of a cloth that may come near each other while its vertices move on straight lines.
class CollisionCandidates {
 public:
  /// @param threads that share a search, in a large cloth
  explicit CollisionCandidates(const Cloth& cloth, const Threads& threads = one_thread());

  /// Finds every pair that comes nearer than `reach` [m] while the vertices go from `from` to `to`, and some more;
  /// those of pins only are left out.
  void find(const std::vector<Point>& from, const std::vector<Point>& to, double reach);

  /// What was found last, sorted: vertices and triangles, then edges and edges.
  [[nodiscard]] const std::vector<FeaturePair>& pairs() const { return pairs_; }

 private:
  /// The boxes around all features on their ways.
  void surround(const std::vector<Point>& from, const std::vector<Point>& to, double margin);

  const Threads& threads_;
  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
  std::vector<int> corners_;  // the vertices of the triangles, each once
  std::vector<char> pinned_;
  std::vector<Box> vertex_boxes_, triangle_boxes_, edge_boxes_;
  SpatialHash triangle_hash_, edge_hash_;
  PartLists<FeaturePair> found_;
  std::vector<FeaturePair> pairs_;
};

}  // namespace drape
