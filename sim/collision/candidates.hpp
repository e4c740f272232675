#pragma once

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
  std::array<int, 4> vertices;  ///< in the order of FourPoints

  auto operator<=>(const FeaturePair&) const = default;  // NOLINT(modernize-use-nullptr): it takes <=> for a 0
};

/// Returns the four points of a pair.
inline FourPoints gather(const std::vector<Point>& points, const std::array<int, 4>& v) {
  return {points[static_cast<std::size_t>(v[0])], points[static_cast<std::size_t>(v[1])],
          points[static_cast<std::size_t>(v[2])], points[static_cast<std::size_t>(v[3])]};
}

/// Returns false only if two features stay further apart than `reach` [m] while their points move on straight lines.
bool may_come_near(Feature feature, const FourPoints& from, FourPoints to, double reach);

/// Search for the pairs of features of a cloth that may come near each other while its vertices move on straight lines.
/// The mean motion of the cloth is subtracted, as it changes no distance.
///
/// Uses a neighbour list with a skin (Verlet 1967). A search keeps all pairs whose enlarged boxes overlap; these boxes
/// cover several further steps at the same velocities, plus a margin. While the boxes of a step stay inside them, only
/// the list is scanned. This gives the same pairs in the same order as a new search.
class CollisionCandidates {
 public:
  /// @param threads shared by a search if the cloth is large
  explicit CollisionCandidates(const Cloth& cloth, const Threads& threads = one_thread());

  /// Finds every pair that comes nearer than `reach` [m] while the vertices move from `from` to `to`, and some more.
  /// Omits pairs whose vertices are all pinned.
  void find(const std::vector<Point>& from, const std::vector<Point>& to, double reach);

  /// Returns the pairs found last, sorted: vertex-triangle pairs, then edge-edge pairs.
  [[nodiscard]] const std::vector<FeaturePair>& pairs() const { return pairs_; }

 private:
  /// Computes the boxes around the paths of all vertices.
  /// @param together mean motion of the cloth, which is subtracted
  void surround(const std::vector<Point>& from, const std::vector<Point>& to, const Point& together, double margin);
  [[nodiscard]] Point mean(const std::vector<Point>& points) const;
  /// Returns the box around the boxes of the vertices.
  [[nodiscard]] Box box(const Edge& edge) const;
  [[nodiscard]] Box box(const Triangle& t) const;
  [[nodiscard]] bool overlap(const FeaturePair& pair) const;
  /// Returns true if every vertex box, shifted back, is inside its kept box and rounding errors are below `rounding`.
  [[nodiscard]] bool kept_cover(const Point& shift, double rounding) const;
  /// Returns the number of further steps at the same velocities that the kept boxes should cover.
  [[nodiscard]] double steps_ahead(const std::vector<Point>& from, const std::vector<Point>& to,
                                   const Point& together) const;
  /// Replaces `pairs` by all accepted pairs with overlapping boxes, sorted.
  template <class Accept>
  void search(Accept&& accept, std::vector<FeaturePair>& pairs);

  const Threads& threads_;
  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
  std::vector<int> corners_;  // vertices of the triangles, without duplicates
  std::vector<char> pinned_;
  std::vector<Box> vertex_boxes_, triangle_boxes_, edge_boxes_;
  SpatialHash triangle_hash_, edge_hash_;
  PartLists<FeaturePair> found_;
  std::vector<FeaturePair> pairs_;
  double edge_length_ = 0;         // mean, at rest [m]
  std::vector<FeaturePair> kept_;  // pairs whose kept boxes overlap
  std::vector<Box> kept_boxes_;    // enlarged boxes of the vertices
  Point kept_middle_{0, 0, 0};     // mean position of the vertices when these boxes were made
};

}  // namespace drape
