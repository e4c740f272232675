#pragma once

#include <array>
#include <span>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "sim/collision/distance.hpp"
#include "sim/collision/monotone_sheet.hpp"
#include "sim/collision/pair_filter.hpp"
#include "sim/collision/placed_mesh.hpp"
#include "sim/collision/spatial_index.hpp"
#include "sim/parallel/loops.hpp"
#include "sim/parallel/threads.hpp"

namespace drape {

/// Search for the pairs of features of a cloth that may come near each other while its vertices move on straight lines.
/// The mean motion is subtracted: it changes no distance. A search uses no earlier one; SelfContacts keeps its pairs.
class CollisionCandidates {
 public:
  /// @param threads shared by a search if the cloth is large
  explicit CollisionCandidates(const Cloth& cloth, const Threads& threads = one_thread());

  /// Finds every pair that comes nearer than `reach` [m] while the vertices move from `from` to `to`, and some more.
  /// Omits pairs whose vertices are all pinned.
  void find(const std::vector<Point>& from, const std::vector<Point>& to, double reach);

  /// Returns the pairs found last, sorted: vertex-triangle pairs, then edge-edge pairs.
  [[nodiscard]] const std::vector<FeaturePair>& pairs() const { return pairs_; }

  /// Calls visit(pair) for those of pairs() that may come within `reach` [m] on the paths of a filter, in their order.
  template <class Visit>
  void for_near(const PairFilter& paths, double reach, Visit&& visit) const {
    const std::span<const FeaturePair> all = pairs_;
    paths.for_near(Feature::vertex_triangle, all.first(vertex_pairs_), reach, visit);
    paths.for_near(Feature::edge_edge, all.subspan(vertex_pairs_), reach, visit);
  }

 private:
  /// Computes the boxes around the paths of all vertices.
  /// @param together mean motion of the cloth, which is subtracted
  void surround(const std::vector<Point>& from, const std::vector<Point>& to, const Point& together, double margin);
  /// Appends the near pairs of the features k < count, for each of which find(k, add) calls add(vertices).
  template <class Find>
  void find_pairs(Feature feature, std::size_t count, double reach, Find&& find);
  [[nodiscard]] Point mean(const std::vector<Point>& points) const;
  /// Returns the box around the boxes of the vertices.
  [[nodiscard]] Box box(const Edge& edge) const;
  [[nodiscard]] Box box(const Triangle& t) const;

  const Threads& threads_;
  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
  std::vector<int> corners_;  // vertices of the triangles, without duplicates
  std::vector<char> pinned_;
  std::vector<Box> vertex_boxes_, triangle_boxes_, edge_boxes_;
  SpatialHash triangle_hash_, edge_hash_;
  PairFilter filter_;
  PartLists<FeaturePair> found_;
  std::vector<FeaturePair> pairs_;
  std::size_t vertex_pairs_ = 0;  // number of vertex-triangle pairs, which are first
};

/// Features of a cloth and a body that may meet, and their distance at the start of the step [m].
struct BodyPair {
  FeaturePair pair;
  double before;
};

/// Straight motion in a step, in the body's coordinates: the cloth's vertices, followed by the body's.
struct BodyStep {
  const std::vector<Point>&from, &to;
  const PlacedMesh &start, &end;
};

/// Search for the pairs of features of a cloth and a body that may come near each other in a step.
///
/// The cloth is searched in groups of triangles. Each group caches the body's triangles in a region around it, and a
/// plane that has all of these on one side. While the group stays in the region and beyond the plane, none of its
/// features comes near the body's. This test costs a few operations per vertex. Region and plane are updated when the
/// group leaves its region. The cache may add or omit distant pairs; near pairs are always found, in the same order.
class BodyCandidates {
 public:
  /// @param margin  distance that the cloth may move before a region is searched again, about [m]
  /// @param threads shared by a search if the cloth is large
  BodyCandidates(const MeshTopology& body, int body_vertices, const Cloth& cloth, double margin,
                 const Threads& threads = one_thread());

  /// Finds every pair that comes nearer than `reach` [m], and some more. Omits pairs whose cloth vertices are all
  /// pinned.
  void find(const BodyStep& step, double reach);

  [[nodiscard]] const std::vector<BodyPair>& pairs() const { return pairs_; }

 private:
  /// Neighbouring triangles of the cloth, with their vertices.
  struct Group {
    std::span<const Patch> patches;
    std::span<const int> vertices;
    Box region;                       // body triangles that overlap it are in `near`; empty at first
    double travel = 0;                // of the body when `near` was found
    std::vector<int> near = {};       // in ascending order
    Point axis = Point::Zero();       // plane axis·x = level, above all triangles of `near`
    double level = 0, of_travel = 0;  // travel of the body when the plane was set
  };
  /// Pairs found in one part of the groups, with buffers for the search.
  struct SearchResults {
    std::vector<BodyPair> pairs;
    std::vector<int> near = {};        // body triangles near a group in a step
    std::vector<Box> near_boxes = {};  // boxes of these triangles
  };
  void find_of(Group& group, const BodyStep& step, double reach, SearchResults& findings) const;
  void look_around(Group& group, const Box& box, const BodyStep& step, double reach) const;
  /// Sets the plane that best separates the group from its near triangles.
  static void place_plane(Group& group, const BodyStep& step);
  [[nodiscard]] static bool apart(const Group& group, const BodyStep& step, double reach);
  void add_group(const Group& group, const BodyStep& step, double reach, SearchResults& findings) const;
  void add_pairs(const Patch& patch, int triangle, const BodyStep& step, double reach,
                 std::vector<BodyPair>& pairs) const;
  void add(const FeaturePair& pair, const BodyStep& step, double reach, std::vector<BodyPair>& pairs) const;

  const Threads& threads_;
  int cloth_count_;
  double margin_;
  std::vector<char> pinned_;
  std::vector<Patch> cloth_patches_, body_patches_;  // the cloth's are sorted by group
  std::vector<int> vertices_;                        // of each group, without duplicates
  std::vector<Group> groups_;
  std::vector<BodyPair> pairs_;
  std::vector<SearchResults> findings_;  // per part
};

}  // namespace drape
