#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "sim/contact/contact.hpp"

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
/// twice the distance plus `margin` [m] count as near.
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

  void find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
            std::vector<ContactConstraint>& contacts) override {
    auto known = held.begin();
    for (int i = 0; i < static_cast<int>(target.rows()); ++i) {
      const Eigen::Vector3d to = target.row(i).transpose() - to_.center;
      while (known != held.end() && known->key.features[0] < i) ++known;
      const bool bears = known != held.end() && known->key.features[0] == i;
      const Eigen::Vector3d from = x_->row(i).transpose() - from_.center;
      if (!bears && to_.gap(to) >= near_ && !to_.crosses(from, to, terms_.distance)) continue;
      contacts.push_back(make(i, from, to, source));
    }
  }

 private:
  ContactConstraint make(int i, const Eigen::Vector3d& from, const Eigen::Vector3d& to, int source) const {
    ContactConstraint contact;
    contact.key = {.source = source, .features = {i, -1, -1, -1}};
    contact.vertices[0] = i;
    contact.weights[0] = 1;
    contact.normal = to_.normal_on_way(from, to, terms_.distance);
    contact.offset = -to_.center - to_.surface_point(contact.normal);
    contact.carried = -(to_.center - from_.center);
    contact.start = from - to_.surface_point(contact.normal);
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

}  // namespace drape
