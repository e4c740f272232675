#include "sim/contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace drape {

Bounce bounce_of(const ContactConstraint& contact, const FreeFlight& flight) {
  if (!(contact.restitution > 0)) return {};
  const Eigen::Vector3d& n = contact.normal;
  const double h = flight.h;
  const double fall = contact.weight() * flight.gravity.dot(n);
  const double c = std::max(0.0, contact.start.dot(n) - contact.distance);
  const double end = contact.place(flight.target).dot(n) - contact.distance;
  if (!(end < 0)) return {};
  const double mean = (end - c) / h, b = mean - 0.5 * fall * h;
  const double steepness = std::sqrt(std::max(0.0, b * b - 2 * fall * c)) - b;
  const double hit = steepness > 0 ? std::min(h, 2 * c / steepness) : h;
  const double speed = -(b + fall * hit), left = h - hit;
  const Eigen::Vector3d before = contact.gather(flight.start_v) - contact.gather(flight.mean);
  const double pressed = std::max(0.0, before.dot(n)), back = contact.restitution * speed;
  if (!(back > pressed)) return {};
  const double gap = std::max(0.0, left * (back + 0.5 * fall * left));
  const double leaves = back + (left - 0.5 * h) * fall;
  return {.gap = gap, .leaves = leaves, .turned = leaves - (gap - c) / h, .struck = speed + back};
}

Eigen::Vector3d change_by(const Bounce& bounce, const ContactConstraint& contact, const Eigen::Vector3d& slip,
                          const Eigen::Vector3d& rubbed) {
  const Eigen::Vector3d& n = contact.normal;
  Eigen::Vector3d across = rubbed - (slip - slip.dot(n) * n);
  const double size = across.norm(), most = contact.friction * bounce.struck;
  if (size > most) across *= most / size;
  return bounce.turned * n + across - rubbed;
}

}  // namespace drape
