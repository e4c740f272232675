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
  std::array<int, 4> vertices;  ///< as in FourPoints

  auto operator<=>(const FeaturePair&) const = default;  // NOLINT(modernize-use-nullptr): it takes <=> for a 0
};

/// The four points of a pair.
inline FourPoints gather(const std::vector<Point>& points, const std::array<int, 4>& v) {
  return {points[static_cast<std::size_t>(v[0])], points[static_cast<std::size_t>(v[1])],
          points[static_cast<std::size_t>(v[2])], points[static_cast<std::size_t>(v[3])]};
}

/// Whether two features may come nearer than `reach` [m] while their points go on straight lines; never misses any that
/// do.
bool may_come_near(Feature feature, const FourPoints& from, FourPoints to, double reach);

/// Finds the pairs of features of a cloth that may come near each other while its vertices move on straight lines. What
/// the whole cloth does together is left out, as it does not bring any nearer to each other.
///
/// As a list of neighbours with a skin (Verlet 1967), a search finds more than is asked for: all pairs whose boxes
/// overlap that hold the ways of some steps as this one, and a little on all sides. While the boxes around what is
/// asked for are inside these, only that list is gone through, which gives the same pairs in the same order as a new
/// search.
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
  /// The boxes around all vertices on their ways.
  /// @param together how far the whole cloth goes
  void surround(const std::vector<Point>& from, const std::vector<Point>& to, const Point& together, double margin);
  [[nodiscard]] Point mean(const std::vector<Point>& points) const;
  /// Around the boxes of vertices.
  [[nodiscard]] Box box(const Edge& edge) const;
  [[nodiscard]] Box box(const Triangle& t) const;
  [[nodiscard]] bool overlap(const FeaturePair& pair) const;
  /// Whether every vertex's box, shifted back, is inside its kept one, for certain if places lose less than `rounding`.
  [[nodiscard]] bool kept_cover(const Point& shift, double rounding) const;
  /// For how many more steps as this one it is worth to make boxes.
  [[nodiscard]] double steps_ahead(const std::vector<Point>& from, const std::vector<Point>& to,
                                   const Point& together) const;
  /// Replaces some pairs by those that are accepted of all whose boxes overlap, sorted.
  template <class Accept>
  void search(Accept&& accept, std::vector<FeaturePair>& pairs);

  const Threads& threads_;
  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
  std::vector<int> corners_;  // the vertices of the triangles, each once
  std::vector<char> pinned_;
  std::vector<Box> vertex_boxes_, triangle_boxes_, edge_boxes_;
  SpatialHash triangle_hash_, edge_hash_;
  PartLists<FeaturePair> found_;
  std::vector<FeaturePair> pairs_;
  double edge_length_ = 0;         // mean, at rest [m]
  std::vector<FeaturePair> kept_;  // of which the boxes overlap that are kept
  std::vector<Box> kept_boxes_;    // of vertices
  Point kept_middle_{0, 0, 0};     // of the vertices when these were made
};

}  // namespace drape
