#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sim/collision/candidates.hpp"
#include "sim/collision/closest_point_cache.hpp"
#include "sim/collision/entanglement.hpp"
#include "sim/collision/monotone_sheet.hpp"
#include "sim/collision/placed_mesh.hpp"
#include "sim/contact/contact.hpp"
#include "sim/contact/seams.hpp"

namespace drape {

/// Parameters of a contact.
struct ContactTerms {
  double distance = 0;     ///< minimum distance of the features [m]
  double friction = 0;     ///< Coulomb's coefficient
  double restitution = 0;  ///< coefficient for impacts, 0 to 1
  bool separate = false;   ///< true to separate features that begin on the wrong side, step by step
};

/// Rate at which features that start too near separate, as a fraction of the missing distance [1/s], and the largest
/// speed of it [m/s]. Both together brake by less than gravity, so that cloth at rest is not thrown up.
inline constexpr double separation_rate = 20, separation_speed = 0.2;

/// Returns the distance required at the end of a step, given the one at its start [m]. Features that are too near
/// separate slowly, as a jump would stretch the cloth.
inline double distance_at_end(double before, double kept, double duration) {
  if (before >= kept) return kept;
  return before + std::min((kept - before) * std::min(1.0, separation_rate * duration), separation_speed * duration);
}

/// Contacts of vertices with a smooth surface that moves as a whole. Surface::at(time) returns a Placed: its `center`
/// [m] and, for positions relative to it, `gap` [m], `crosses`, `normal_on_way` and `surface_point`. Vertices within
/// twice the distance plus `margin` [m] count as near. `stay_clear` leaves out whole blocks of vertices.
template <class Surface>
class SurfaceContacts final : public ContactSource {
 public:
  SurfaceContacts(Surface surface, const ContactTerms& terms) : surface_(std::move(surface)), terms_(terms) {}

  void begin(const Vertices& x, double start, double end) override {
    x_ = &x;
    duration_ = end - start;
    from_ = surface_.at(start);
    to_ = surface_.at(end);
    near_ = 2 * terms_.distance + to_.margin();
  }

  [[nodiscard]] bool separates() const override { return terms_.separate; }
  void find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
            std::vector<ContactConstraint>& contacts) override {
    auto known = held.begin();
    const int count = static_cast<int>(target.rows());
    for (int i = 0; i < count; ++i) {
      while (known != held.end() && known->key.features[0] < i) ++known;
      const bool bears = known != held.end() && known->key.features[0] < i + block_size;
      if (i % block_size == 0 && i + block_size <= count && !bears && passes_by(target, i)) {
        i += block_size - 1;
        continue;
      }
      add(i, target, known != held.end() && known->key.features[0] == i, source, contacts);
    }
  }

 private:
  static constexpr int block_size = SurfaceBlock::RowsAtCompileTime;

  /// Returns true if the block of vertices that begins with `first` stays clear of the surface.
  [[nodiscard]] bool passes_by(const Vertices& target, int first) const {
    const auto relative = [&](const Vertices& x, const Eigen::Vector3d& center) -> SurfaceBlock {
      return x.middleRows<block_size>(first).rowwise() - center.transpose();
    };
    return to_.stay_clear(relative(*x_, from_.center), relative(target, to_.center), near_, terms_.distance);
  }
  void add(int i, const Vertices& target, bool bears, int source, std::vector<ContactConstraint>& contacts) const {
    const Eigen::Vector3d to = target.row(i).transpose() - to_.center;
    const Eigen::Vector3d from = x_->row(i).transpose() - from_.center;
    if (!bears && to_.gap(to) >= near_ && !to_.crosses(from, to, terms_.distance)) return;
    contacts.push_back(make(i, from, to, source));
  }
  ContactConstraint make(int i, const Eigen::Vector3d& from, const Eigen::Vector3d& to, int source) const {
    ContactConstraint contact;
    contact.key = {.source = source, .features = {i, -1, -1, -1}};
    contact.vertices[0] = i;
    contact.weights[0] = 1;
    contact.normal = to_.normal_on_way(from, to, terms_.distance);
    contact.offset = -to_.center - to_.surface_point(contact.normal);
    const Eigen::Vector3d surface = from_.surface_point(contact.normal);
    contact.carried = -(to_.center - from_.center) - (to_.surface_point(contact.normal) - surface);
    contact.start = from - surface;
    const double before = from_.gap(from);
    contact.distance = distance_at_end(before, terms_.distance, duration_);
    contact.friction = terms_.friction;
    contact.restitution = terms_.restitution;
    contact.collides = terms_.distance > 0 && before >= 0 && to_.gap(to) < 0;
    return contact;
  }

  Surface surface_;
  ContactTerms terms_;
  const Vertices* x_ = nullptr;
  double duration_ = 0;
  double near_ = 0;  // search radius at the end of a step; these contacts may bear a force soon [m]
  typename Surface::Placed from_, to_;
};

/// Straight paths of two features in a step, and their distance at its start.
struct FeaturePaths {
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
std::optional<Touch> find_touch(const FeaturePaths& paths, double distance, bool held);

/// Contacts of a cloth with itself, and of its pieces with each other: vertex-triangle and edge-edge pairs that share
/// no vertex. Features that a seam joins keep at most their distance along the cloth, across the seam.
class SelfContacts final : public ContactSource {
 public:
  /// @param frictions coefficients between the cloth's pieces, symmetric; without several pieces it is not used
  SelfContacts(const ContactTerms& terms, const Cloth& cloth, const Threads& threads, Eigen::MatrixXd frictions = {});
  void begin(const Vertices& x, double start, double end) override;
  void find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
            std::vector<ContactConstraint>& contacts) override;
  [[nodiscard]] bool separates() const override { return terms_.separate; }

 private:
  /// Returns true if the candidates cover this step: all vertices are near the positions predicted in their search.
  [[nodiscard]] bool go_as_expected() const;
  void find_candidates();
  /// Returns the contact of four vertices, without key and distance.
  [[nodiscard]] ContactConstraint make(const std::array<int, 4>& vertices, const std::array<double, 4>& weights,
                                       const Point& normal) const;
  /// Returns true if a key names features of this cloth that may touch. The keys of a State may come from anywhere.
  [[nodiscard]] bool is_pair_of_cloth(const ContactKey& key) const;
  /// Appends the contact of a pair, if there is one.
  void add(const FeaturePair& pair, int source, bool held, std::vector<ContactConstraint>& contacts) const;
  /// Appends the contacts that bring back features that have passed through a triangle.
  void bring_back(int source, std::vector<ContactConstraint>& contacts) const;
  /// Returns the distance of two features in the rest shape, across a seam if that is shorter; infinite between
  /// different pieces without a seam [m].
  [[nodiscard]] double rest_distance(const FeaturePair& pair) const;
  /// Returns the friction coefficient of two features.
  [[nodiscard]] double friction(const FeaturePair& pair) const;

  ContactTerms terms_;
  const Cloth& cloth_;
  std::vector<int> pieces_;  // number of each vertex's piece; empty for one piece
  Eigen::MatrixXd frictions_;
  SeamDistances seams_;
  std::optional<MonotoneSheet> sheet_;        // rules out any search; made by the first step, as many systems make none
  CollisionCandidates candidates_;            // kept for `steps_ahead_` steps at constant velocities
  PairFilter filter_;                         // for the step
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
  [[nodiscard]] bool separates() const override { return terms_.separate; }

 private:
  /// Makes the search structures; called by the first step, as many systems make none.
  void prepare();
  [[nodiscard]] bool is_clear(const Vertices& target) const;
  void find_vertices(int source, const std::vector<ContactConstraint>& held, std::vector<ContactConstraint>& contacts);
  void find_pairs(int source, const std::vector<ContactConstraint>& held, std::vector<ContactConstraint>& contacts);
  /// Copies the shape at the start and end of the step, in the body's own coordinates.
  void copy_shape();
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
    double share;          ///< of the way from its first to its second end, where the middle of the part inside is
    ClosestPoint closest;  ///< of that
  };

  std::shared_ptr<const MovingBody> body_;
  ContactTerms terms_;
  const Cloth& cloth_;
  const Threads& threads_;
  int cloth_count_;
  BodyAt start_, end_;
  std::optional<BodyCandidates> candidates_;
  ClosestPointCache closest_, start_closest_;
  double duration_ = 0;
  bool searched_ = false;
  std::optional<Entanglement> entanglement_;   // at the start of the step, if it is to be separated
  std::vector<char> inside_;                   // nonzero for vertices of the cloth inside at the start of the step
  std::vector<Through> through_;               // by edge
  const Vertices* world_ = nullptr;            // positions at the start of the step
  std::vector<Point> x_, target_, found_for_;  // in the body's coordinates; cloth first, then body
};

}  // namespace drape
