#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "sim/collision/body_candidates.hpp"
#include "sim/collision/candidates.hpp"
#include "sim/collision/foot_memory.hpp"
#include "sim/contact/surface_contacts.hpp"
#include "sim/moving_body.hpp"

namespace drape {

/// Where two features are in a step, on straight ways, and how they touch at its end.
struct FeatureWays {
  Feature feature;
  FourPoints from, to;
  double before;  ///< distance at the start [m]
};

/// How two features touch: weights of the four points, and the direction from the second to the first.
struct Touch {
  std::array<double, 4> weights;
  Point normal;
  bool collides;  ///< on the way
};

/// Finds how two features touch that end nearer than `distance` [m] or collide on their way; nothing if they do neither
/// and are not `held`.
std::optional<Touch> find_touch(const FeatureWays& ways, double distance, bool held);

/// Contacts of a cloth with itself: vertices with triangles, and edges with edges, that share no vertex.
class SelfContacts final : public ContactSource {
 public:
  SelfContacts(const ContactTerms& terms, const Cloth& cloth, const Threads& threads);
  void begin(const Vertices& x, double start, double end) override;
  void find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
            std::vector<ContactConstraint>& contacts) override;

 private:
  /// Returns true if the candidates hold for this step: the vertices go as expected when they were found.
  [[nodiscard]] bool go_as_expected() const;
  void find_candidates();
  /// Appends the contact of a pair, if it has one.
  void add(const FeaturePair& pair, int source, bool held, std::vector<ContactConstraint>& contacts) const;
  /// Distance of two features in the rest shape [m].
  [[nodiscard]] double rest_distance(const FeaturePair& pair) const;

  ContactTerms terms_;
  const Cloth& cloth_;
  CollisionCandidates candidates_;  // of some steps as the one in which they were found
  double duration_ = 0;
  int steps_since_ = 0, steps_ahead_ = 0;
  std::vector<Point> x_, target_, found_at_, way_, ahead_;
};

/// Contacts of a cloth with a body: vertices of the cloth keep the whole distance from its surface; its edges and
/// corners come as near as a part of it, so that a cloth coarser than the body is not poked through.
class BodyContacts final : public ContactSource {
 public:
  /// Part of the distance that edges and the body's corners keep.
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
  /// Takes out those of the vertices' contacts, from `begin` to `pairs`, that would hold a vertex on the side of a
  /// shell to which it has passed.
  static void leave_wrong_sides(std::vector<ContactConstraint>& contacts, std::ptrdiff_t begin, std::ptrdiff_t pairs);
  /// The contact of features whose touch is known in the body's coordinates.
  [[nodiscard]] ContactConstraint make(const std::array<int, 4>& vertices, const std::array<double, 4>& weights,
                                       const Point& normal) const;

  std::shared_ptr<const MovingBody> body_;
  ContactTerms terms_;
  int cloth_count_;
  BodyAt start_, end_;
  BodyCandidates candidates_;
  FootMemory feet_, start_feet_;
  double duration_ = 0;
  bool searched_ = false;
  const Vertices* world_ = nullptr;            // x at the start of the step
  std::vector<Point> x_, target_, found_for_;  // in the body's coordinates, its own points last
};

}  // namespace drape
