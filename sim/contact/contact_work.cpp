// Energy of a solved step in contact: the work of the contacts' forces, what drives them, and bounces after the step.

#include <algorithm>
#include <cstddef>

#include "sim/contact/contact_solver.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

using Index = std::size_t;

}  // namespace

double ContactSolver::separating_work(const ContactConstraint& contact, const Eigen::Vector3d& force) const {
  if (contact.law == ContactLaw::length) {
    const double length = contact.start.norm();
    return force.norm() * std::max(0.0, contact.distance - (contact.distance < 0 ? -length : length));
  }
  if (!source(contact.key.source).separates()) return 0;
  return force.dot(contact.normal) * std::max(0.0, contact.distance - contact.start.dot(contact.normal));
}

double ContactSolver::work(const Vertices& x, bool converged) const {
  double work = 0;
  for (const ContactConstraint& contact : contacts_) {
    const Eigen::Vector3d force = respond(contact, x).force;
    const double by_force = force.dot(contact.place(x) - contact.start);
    // A turning edge that pushes would gain energy from its limit.
    const bool whole = converged && contact.law != ContactLaw::length;
    work += (whole ? by_force : std::min(by_force, separating_work(contact, force))) -
            force.dot(contact.carried + way_of_pins(contact, x));
  }
  return work;
}

Eigen::RowVector3d ContactSolver::mean_drive(const Vertices& x) const {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  int count = 0;
  for (const ContactConstraint& contact : contacts_) {
    if (contact.with_obstacle()) {
      sum -= contact.carried.transpose() / contact.weight();
      ++count;
    }
    for (Index i = 0; i < static_cast<Index>(contact.count); ++i) {
      const int vertex = contact.vertices[i];
      if (inverse_masses_[static_cast<Index>(vertex)] != 0) continue;
      sum += x.row(vertex) - start_.row(vertex);
      ++count;
    }
  }
  return count == 0 ? sum : sum / count;
}

Eigen::RowVector3d ContactSolver::force_on_cloth(const Vertices& x) const {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (const ContactConstraint& contact : contacts_) {
    const Eigen::Vector3d force = respond(contact, x).force;
    for (Index i = 0; i < static_cast<Index>(contact.count); ++i) {
      if (inverse_masses_[static_cast<Index>(contact.vertices[i])] != 0) sum += contact.weights[i] * force.transpose();
    }
  }
  return sum;
}

Eigen::Vector3d ContactSolver::way_of_pins(const ContactConstraint& contact, const Vertices& x) const {
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  if (system_.pin_motions.empty()) return way;
  for (Index i = 0; i < static_cast<Index>(contact.count); ++i) {
    const int vertex = contact.vertices[i];
    if (inverse_masses_[static_cast<Index>(vertex)] != 0) continue;
    way += contact.weights[i] * (x.row(vertex) - start_.row(vertex)).transpose();
  }
  return way;
}

bool ContactSolver::driven(const Vertices& x) const {
  return carried() || std::ranges::any_of(contacts_, [&](const ContactConstraint& contact) {
           return !way_of_pins(contact, x).isZero(0);
         });
}

bool ContactSolver::touches_obstacles() const {
  return std::ranges::any_of(contacts_, [](const ContactConstraint& contact) { return contact.with_obstacle(); });
}

bool ContactSolver::carried() const {
  return std::ranges::any_of(contacts_, [](const ContactConstraint& contact) { return !contact.carried.isZero(0); });
}

void ContactSolver::rebound(bool instantaneous, Vertices& v) const {
  for (const ContactConstraint& contact : contacts_) {
    const Eigen::Vector3d& n = contact.normal;
    if (contact.welds || contact.law == ContactLaw::length || !(contact.force.dot(n) > 0)) continue;
    const double compliance = contact.compliance(inverse_masses_);
    const auto change = [&](const Eigen::Vector3d& by) { contact.push(inverse_masses_, by / compliance, v); };
    const Eigen::Vector3d drift = contact.carried / flight_.h, slip = contact.gather(v) + drift;
    const double now = slip.dot(n);
    Bounce bounce = bounce_of(contact, flight_);
    if (bounce.struck > 0) {
      const double later = instantaneous ? flight_.h / 2 * contact.weight() * flight_.gravity.dot(n) : 0;
      bounce.turned = bounce.leaves + later - now;  // independent of the gap that the solve left
      change(change_by(bounce, contact, slip, flight_.h * compliance * contact.force));
      continue;
    }
    // A vertex that slides on a ball moves along a chord: turn its end velocity along the surface again.
    const double most = std::max(0.0, (contact.gather(flight_.mean) + drift).dot(n));
    if (instantaneous && now > most) change((most - now) * n);
  }
}

}  // namespace drape
