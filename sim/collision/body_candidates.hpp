#pragma once

#include <span>
#include <vector>

#include "sim/cloth.hpp"
#include "sim/collision/candidates.hpp"
#include "sim/collision/patches.hpp"
#include "sim/collision/placed_mesh.hpp"
#include "sim/parallel/threads.hpp"

namespace drape {

/// Features of a cloth and a body that may meet, and which of the body's it is: a triangle, or a corner of it or the
/// edge that begins there.
struct BodyPair {
  FeaturePair pair;
  int triangle, corner;
  Nearest before;  ///< their nearest points when the step begins
};

/// Where a step leads, in the body's coordinates: the cloth's vertices on straight lines, followed by the body's.
struct BodyStep {
  const std::vector<Point>&from, &to;
  const PlacedMesh &start, &end;
};

/// Finds the pairs of features of a cloth and a body that may come near each other in a step.
///
/// The cloth is looked at in groups of triangles. Of each it is known which of the body's triangles are in a region
/// around it, and a plane that has all of these on one side: as long as the group stays in the region and on the other
/// side of the plane, which takes a few operations a vertex to see, none of its features comes near any of the body's.
/// Both are searched anew when the group leaves its region. Pairs that do not come near are left out or not as this
/// memory has it; those that do are found whatever it has, and in the same order.
class BodyCandidates {
 public:
  /// @param margin  how far the cloth may go before a region is left, about [m]
  /// @param threads that share a search, in a large cloth
  BodyCandidates(const MeshTopology& body, int body_vertices, const Cloth& cloth, double margin,
                 const Threads& threads = one_thread());

  /// Finds every pair that comes nearer than `reach` [m], and some more; those of pins only are left out.
  void find(const BodyStep& step, double reach);
  /// The same in the same step, where some of the cloth's vertices go elsewhere: the pairs of all others stay.
  void find_again(const BodyStep& step, double reach, const std::vector<char>& changed);

  [[nodiscard]] const std::vector<BodyPair>& pairs() const { return pairs_; }

 private:
  /// Triangles of the cloth, with their vertices, that are near each other.
  struct Group {
    std::span<const Patch> patches;
    std::span<const int> vertices;
    Box region;                        // all of the body in it are `near` triangles; nothing at first
    double travel = 0;                 // of the body when that was so
    std::vector<int> near = {};        // increasing
    Point axis = Point::Zero();        // they are all below axis·x = level
    double level = 0, of_travel = 0;   // when the body had travelled so far
    std::size_t begin = 0, count = 0;  // of its pairs
  };
  /// What is found in a part of the groups, and memory for finding it.
  struct Findings {
    std::vector<BodyPair> pairs;
    std::vector<int> near = {};        // what is near a group in a step
    std::vector<Box> near_boxes = {};  // of those
  };
  /// Makes the pairs of what find(group, findings) adds for each group.
  template <class Find>
  void find_all(Find&& find);
  void find_of(Group& group, const BodyStep& step, double reach, Findings& findings) const;
  void look_around(Group& group, const Box& box, const BodyStep& step, double reach) const;
  /// Puts the plane between the group and what is near it as well as it can.
  static void place_plane(Group& group, const BodyStep& step);
  [[nodiscard]] static bool apart(const Group& group, const BodyStep& step, double reach);
  void add_group(const Group& group, const BodyStep& step, double reach, Findings& findings) const;
  void add_pairs(const Patch& patch, int triangle, const BodyStep& step, double reach,
                 std::vector<BodyPair>& pairs) const;
  void add(const FeaturePair& pair, int triangle, int corner, const BodyStep& step, double reach,
           std::vector<BodyPair>& pairs) const;

  const Threads& threads_;
  int cloth_count_;
  double margin_;
  std::vector<char> pinned_;
  std::vector<Patch> cloth_patches_, body_patches_;  // the cloth's group by group
  std::vector<int> vertices_;                        // of each group, each once
  std::vector<Group> groups_;
  std::vector<BodyPair> pairs_, before_;
  std::vector<Findings> findings_;  // of each part
};

}  // namespace drape
