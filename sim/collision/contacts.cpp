#include "sim/collision/contacts.hpp"

#include <algorithm>

namespace drape {

Contact::Contact(const FeaturePair& pair, const std::array<double, 4>& w, const Point& difference, double speed,
                 const MovingVertices& moving)
    : vertices(pair.vertices), weights(w), normal(difference.normalized()), least_speed(speed) {
  for (std::size_t i = 0; i < 4; ++i) inverse_mass += w[i] * w[i] * moving.inverse_mass(vertices[i]);
}

void Contact::apply(double coefficient, MovingVertices& moving) {
  if (!(inverse_mass > 0)) return;
  Point relative = Point::Zero();
  for (std::size_t i = 0; i < 4; ++i) relative += weights[i] * moving.velocity(vertices[i]);
  const double speed = relative.dot(normal);
  if (impulse == 0 && speed >= least_speed) return;  // as most do
  const double pushed = std::max(0.0, impulse + (least_speed - speed) / inverse_mass);
  if (pushed == 0 && impulse == 0) return;

  Point slowed = friction - (relative - speed * normal) / inverse_mass;
  const double most = coefficient * pushed, wanted = slowed.norm();
  if (wanted > most) slowed *= most / wanted;
  const Point change = (pushed - impulse) * normal + (slowed - friction);
  impulse = pushed;
  friction = slowed;
  for (std::size_t i = 0; i < 4; ++i) {
    if (moving.inverse_mass(vertices[i]) == 0) continue;
    moving.velocities[static_cast<std::size_t>(vertices[i])] += weights[i] * moving.inverse_mass(vertices[i]) * change;
  }
}

}  // namespace drape
