#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sim/collision/body_candidates.hpp"
#include "sim/collision/impulse_filter.hpp"
#include "sim/moving_body.hpp"
#include "sim/parallel/part_lists.hpp"

namespace drape {

/// What a body does to a cloth beside pushing its vertices.
struct BodyLaw {
  double thickness;  ///< of the layer around it in which it pushes [m]
  double friction;   ///< Coulomb's coefficient
  double rate;       ///< at which what is too near leaves, as a part of what is missing [1/s]
};

/// Keeps a cloth from going through a body however far either moves in a step, and a body's corners and edges from
/// poking through a cloth that is coarser than it (after Bridson, Fedkiw and Anderson 2002, as SelfContact): features
/// of cloth and body that come nearer than `kept_part` of the thickness are contacts with friction, solved for by
/// projected Gauss-Seidel, and so is what collides on its way all the same (time_of_impact). What still collides after
/// a few passes goes with the body.
///
/// All of it is in the body's own coordinates: a rigid body stands still there, so that its tree is built once. A
/// contact's normal is that of the triangle or of the two edges that meet, so that what slides on a flat face meets no
/// edges in it.
class BodyContact final : public ImpulseFilter {
 public:
  /// What is kept free by contacts, as a part of the thickness. The rest is the push's.
  static constexpr double kept_part = 0.25;

  BodyContact(std::shared_ptr<const MovingBody> body, const BodyLaw& law, const Cloth& cloth,
              const Threads& threads = one_thread());

  void apply(const Vertices& x, double time, double h, Vertices& v) override;

 private:
  struct Impact {
    BodyPair met;
    Contact contact;
  };

  /// Whether all of the cloth stays further from all of the body than anything matters.
  [[nodiscard]] bool clear(const Vertices& x, double h, const Vertices& v) const;
  void load(const Vertices& x, double h, const Vertices& v);
  /// Whether the places are so exact that cloth and body can be told apart.
  [[nodiscard]] bool resolved() const;
  void place_body();
  void store(const Vertices& x, Vertices& v) const;
  /// What may come so near in a step is looked at [m].
  [[nodiscard]] double reach() const;
  /// Whether two features meet at a pin, or almost: where that is, nothing else can change.
  [[nodiscard]] bool is_at_pin(const FeaturePair& pair, const std::array<double, 4>& weights) const;
  /// A contact of two features as they are at a part of the step; nothing if they meet from a solid's inside or at a
  /// pin.
  /// @param near only if they are opposite each other and too near at the end of the step
  [[nodiscard]] std::optional<Contact> contact(const BodyPair& met, double time, bool near) const;
  /// The way out of a solid where a pair meets it, in the direction from its second feature to its first; zero on a
  /// shell.
  [[nodiscard]] Point outwards(const BodyPair& met) const;
  void repel();
  void stop_impacts();
  void go_with_body();
  void solve();
  /// Of features that collide on their way, with a contact when they do.
  void find_impacts();
  void add_impact(const BodyPair& met, std::vector<Impact>& impacts) const;
  /// The target of every vertex whose velocity has changed; finds its candidates anew if it went further than they were
  /// found for.
  void move_targets();
  /// How far a vertex is from the way for which its candidates were found [m].
  [[nodiscard]] double astray(std::size_t i) const;

  std::shared_ptr<const MovingBody> body_;
  BodyLaw law_;
  int cloth_count_;  // the body's vertices are numbered on from the cloth's; all are in the body's coordinates
  BodyAt start_, end_;
  BodyCandidates candidates_;
  std::vector<char> moved_, held_;  // vertices of other velocities than they came with; with the body's
  std::vector<char> far_;           // vertices whose pairs are to be found anew
  PartLists<Contact> near_;         // at the start of the step
  PartLists<Impact> found_;
  std::vector<Contact> contacts_;
  std::vector<Impact> impacts_;
};

}  // namespace drape
