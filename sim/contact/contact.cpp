#include "sim/contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace drape {

std::vector<double> inverse_masses(const Cloth& cloth) {
  std::vector<double> inverse;
  for (const double mass : cloth.masses) inverse.push_back(1 / mass);
  for (const int pin : cloth.pins) inverse[static_cast<std::size_t>(pin)] = 0;
  return inverse;
}

Eigen::VectorXd spring_pull(const std::vector<Spring>& springs, const Eigen::VectorXd& masses) {
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(masses.size());
  for (const Spring& spring : springs) {
    pull[spring.i] += spring.stiffness;
    pull[spring.j] += spring.stiffness;
  }
  return pull.cwiseQuotient(masses);
}

namespace {

constexpr double most_pull = 1.0 / 8;  // largest h² Σk/m of a vertex in free flight

/// Returns true if the springs at a contact act too much within the step for free flight.
bool is_stiff(const ContactConstraint& contact, const FreeFlight& flight) {
  const auto end = contact.vertices.begin() + contact.count;
  return std::any_of(contact.vertices.begin(), end,
                     [&](int vertex) { return flight.h * flight.h * flight.pull[vertex] > most_pull; });
}

}  // namespace

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
  if (is_stiff(contact, flight)) return {.leaves = back, .struck = speed + back, .stiff = true};
  const double gap = std::max(0.0, left * (back + 0.5 * fall * left));
  const double leaves = back + (left - 0.5 * h) * fall;
  return {.gap = gap, .leaves = leaves, .turned = leaves - (gap - c) / h, .struck = speed + back};
}

Eigen::Vector3d change_by(const Bounce& bounce, const ContactConstraint& contact, const Eigen::Vector3d& slip,
                          const Eigen::Vector3d& pushed) {
  const Eigen::Vector3d& n = contact.normal;
  double turned = bounce.turned, struck = bounce.struck;
  Eigen::Vector3d rubbed = pushed - pushed.dot(n) * n;
  if (bounce.stiff) {
    // The step has stopped the part of the motion that would have entered the obstacle.
    const double now = slip.dot(n), arrives = std::max(0.0, -now);
    const double most = contact.restitution * (pushed.dot(n) + arrives);
    turned = struck = arrives + std::max(0.0, std::min(bounce.leaves - std::max(0.0, now), most));
    rubbed.setZero();
  }
  Eigen::Vector3d across = rubbed - (slip - slip.dot(n) * n);
  const double size = across.norm(), most = contact.friction * struck;
  if (size > most) across *= most / size;
  return turned * n + across - rubbed;
}

}  // namespace drape
