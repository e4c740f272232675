#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "sim/collision/distance.hpp"
#include "sim/collision/monotone_sheet.hpp"
#include "sim/collision/placed_mesh.hpp"
#include "sim/collision/spatial_index.hpp"
#include "sim/parallel/loops.hpp"
#include "sim/parallel/threads.hpp"

namespace drape {

/// Two features that share no vertex and may touch in a step.
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

/// Fast rejection of pairs that stay apart while their vertices move on straight paths. It computes in single
/// precision, eight pairs at once, and never rejects a pair that comes within the reach.
///
/// A pair is rejected if a slab separates its features at both ends of the paths; then it does so in between. The
/// vector between the closest points in the middle of the paths is a good axis, but any axis proves the distance, so
/// its error does not matter. The width of the slab has a rounding error. Let u = 2⁻²⁴, and S the size of the largest
/// coordinate, relative to the middle of all points. Rounding moves a coordinate by uS, and the difference of two by
/// another 2uS. A product of axis n and difference d errs by 3u Σ|nᵢ||dᵢ| ≤ 6uS Σ|nᵢ|. Each height on the axis then
/// errs by at most 10uS Σ|nᵢ| ≤ 18uS ‖n‖, and the difference of two by 36uS ‖n‖, with 7uS ‖n‖ for its own rounding:
/// less than 64uS ‖n‖. The squares that are compared have relative errors of at most 8u.
class PairFilter {
 public:
  /// Sets the paths of all vertices.
  void set(const std::vector<Point>& from, const std::vector<Point>& to);

  /// Calls visit(pair) for the pairs that may come within `reach` [m], in their order. All are of one kind.
  template <class Visit>
  void for_near(Feature feature, std::span<const FeaturePair> pairs, double reach, Visit&& visit) const {
    std::array<int, at_once> near;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
    for (; !pairs.empty(); pairs = pairs.subspan(std::min(at_once, pairs.size()))) {
      const int found = find(feature, pairs.first(std::min(at_once, pairs.size())), reach, near);
      for (int n = 0; n < found; ++n) {
        visit(pairs[static_cast<std::size_t>(near[static_cast<std::size_t>(n)])]);
      }
    }
  }

 private:
  static constexpr std::size_t at_once = 256;
  /// Finds the numbers of the near pairs; returns how many there are.
  [[nodiscard]] int find(Feature feature, std::span<const FeaturePair> pairs, double reach,
                         std::array<int, at_once>& near) const;

  std::vector<std::array<float, 8>> rows_;  // x, y, z, 0 at the start and at the end, relative to the middle [m]
  double size_ = 0;                         // largest coordinate [m]
};

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
    Box region = {};                  // body triangles that overlap it are in `near`; empty at first
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
