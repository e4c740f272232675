#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "sim/collision/body_candidates.hpp"
#include "sim/collision/candidates.hpp"
#include "sim/collision/closest_point_cache.hpp"
#include "sim/collision/entanglement.hpp"
#include "sim/collision/monotone_sheet.hpp"
#include "sim/contact/surface_contacts.hpp"
#include "sim/moving_body.hpp"

namespace drape {

/// Straight paths of two features in a step, and their distance at its start.
struct FeatureWays {
  Feature feature;
  FourPoints from, to;
  double before;  ///< distance at the start [m]
};

/// Contact of two features: weights of the four points, and the direction from the second to the first.
struct Touch {
  std::array<double, 4> weights;
  Point normal;
  bool collides;  ///< on the path
};

/// Returns the contact of two features that end nearer than `distance` [m], collide on their path or are `held`.
/// Returns nothing for other features.
std::optional<Touch> find_touch(const FeatureWays& ways, double distance, bool held);

/// Contacts of a cloth with itself: vertex-triangle and edge-edge pairs that share no vertex.
class SelfContacts final : public ContactSource {
 public:
  SelfContacts(const ContactTerms& terms, const Cloth& cloth, const Threads& threads);
  void begin(const Vertices& x, double start, double end) override;
  void find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
            std::vector<ContactConstraint>& contacts) override;

 private:
  /// Returns true if the candidates cover this step: all vertices are near the positions predicted in their search.
  [[nodiscard]] bool go_as_expected() const;
  void find_candidates();
  /// Returns the contact of four vertices, without key and distance.
  [[nodiscard]] ContactConstraint make(const std::array<int, 4>& vertices, const std::array<double, 4>& weights,
                                       const Point& normal) const;
  /// Appends the contact of a pair, if there is one.
  void add(const FeaturePair& pair, int source, bool held, std::vector<ContactConstraint>& contacts) const;
  /// Appends the contacts that bring back features that have passed through a triangle.
  void bring_back(int source, std::vector<ContactConstraint>& contacts) const;
  /// Returns the distance of two features in the rest shape [m].
  [[nodiscard]] double rest_distance(const FeaturePair& pair) const;

  ContactTerms terms_;
  const Cloth& cloth_;
  std::optional<MonotoneSheet> sheet_;        // made by the first step: many systems are only asked what they touch
  CollisionCandidates candidates_;            // for `steps_ahead_` steps at constant velocities
  std::optional<Entanglement> entanglement_;  // at the start of the step, if it is to be separated
  double duration_ = 0;
  int steps_since_ = 0, steps_ahead_ = 0;
  std::vector<Point> x_, target_, found_at_, way_, ahead_;
};

/// Contacts of a cloth with a body. Cloth vertices keep the full distance from its surface. Cloth edges and the body's
/// corners keep a fraction, so that the body does not poke through a coarser cloth.
class BodyContacts final : public ContactSource {
 public:
  /// Fraction of the distance that edges and the body's corners keep.
  static constexpr double kept_part = 0.25;

  BodyContacts(std::shared_ptr<const MovingBody> body, const ContactTerms& terms, const Cloth& cloth,
               const Threads& threads);
  void begin(const Vertices& x, double start, double end) override;
  void find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
            std::vector<ContactConstraint>& contacts) override;

 private:
  [[nodiscard]] bool is_clear(const Vertices& target) const;
  void find_vertices(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
                     std::vector<ContactConstraint>& contacts);
  void find_pairs(int source, const std::vector<ContactConstraint>& held, std::vector<ContactConstraint>& contacts);
  /// Finds the features that begin the step on the wrong side of the body.
  void find_astray();
  /// Finds edges of the cloth that pass through a solid while both of their ends are outside.
  void find_through();
  /// Appends the contacts that bring these out.
  void bring_out(int source, std::vector<ContactConstraint>& contacts) const;
  /// Returns true if features include one on the wrong side.
  [[nodiscard]] bool is_astray(const FeaturePair& pair) const;
  /// Appends the contacts that bring back features that have passed through a triangle.
  void bring_back(int source, std::vector<ContactConstraint>& contacts) const;
  /// Removes vertex contacts, from `begin` to `pairs`, whose normal would hold a vertex on the wrong side of a shell
  /// that it has passed through.
  static void leave_wrong_sides(std::vector<ContactConstraint>& contacts, std::ptrdiff_t begin, std::ptrdiff_t pairs);
  /// Returns the contact for a touch given in the body's coordinates.
  [[nodiscard]] ContactConstraint make(const std::array<int, 4>& vertices, const std::array<double, 4>& weights,
                                       const Point& normal) const;

  /// An edge of the cloth through a solid.
  struct Through {
    Edge edge;
    double share;       ///< of the way from its first to its second end, where the middle of the part inside is
    ClosestPoint foot;  ///< of that
  };

  std::shared_ptr<const MovingBody> body_;
  ContactTerms terms_;
  int cloth_count_;
  BodyAt start_, end_;
  BodyCandidates candidates_;
  ClosestPointCache feet_, start_feet_;
  double duration_ = 0;
  bool searched_ = false;
  std::optional<Entanglement> entanglement_;   // at the start of the step, if it is to be separated
  std::vector<char> inside_;                   // nonzero for vertices of the cloth inside at the start of the step
  std::vector<Through> through_;               // by edge
  const Vertices* world_ = nullptr;            // positions at the start of the step
  std::vector<Point> x_, target_, found_for_;  // in the body's coordinates; cloth first, then body
};

}  // namespace drape
