#pragma once

#include "sim/collision/impulse_filter.hpp"
#include "sim/collision/rigid_zones.hpp"
#include "sim/collision/smooth_sheet.hpp"
#include "sim/effects/self_collision.hpp"
#include "sim/parallel/part_lists.hpp"

namespace drape {

/// Keeps a cloth from going through itself (after Bridson, Fedkiw and Anderson 2002, sections 6 and 7), in three steps:
/// 1. Features nearer than the thickness are kept from coming nearer and pushed apart, those that would come nearer
/// than
///    it within the step are slowed down: contacts with friction, solved for by projected Gauss-Seidel.
/// 2. Features that still collide on the way (time_of_impact) get inelastic impulses, in a few passes.
/// 3. What collides after that moves as a rigid body, see RigidZones. After this step nothing collides.
/// A cloth of which nothing can come near anything, see SmoothSheet, is not searched at all, with the same bits.
/// Every change is by opposite impulses or keeps momentum otherwise, so linear momentum is kept to rounding.
class SelfContact final : public ImpulseFilter {
 public:
  SelfContact(const SelfCollision& values, const Cloth& cloth, const Threads& threads = one_thread());

  void apply(const Vertices& x, double time, double h, Vertices& v) override;

 private:
  void load(const Vertices& x, double h, const Vertices& v);
  void find_candidates();
  void repel();
  void stop_impacts();
  void make_rigid();
  /// The pairs that collide in this step, of those of which a vertex was changed since they were last asked for.
  void find_impacts();
  /// The target of every vertex whose velocity has changed; finds the candidates anew if one went further than they
  /// were found for.
  void move_targets();
  [[nodiscard]] double rest_distance(const FeaturePair& pair) const;
  /// Appends a pair's contact, if it is to have one.
  void add_contact(const FeaturePair& pair, std::vector<Contact>& contacts) const;

  struct Impact {
    FeaturePair pair;
    double time;  // as a part of the step
  };

  SelfCollision values_;
  const Cloth& cloth_;
  CollisionCandidates candidates_;
  SmoothSheet sheet_;
  RigidZones zones_;
  PartLists<Contact> contacts_;
  PartLists<Impact> found_;
  std::vector<Impact> impacts_;
};

}  // namespace drape
