#include "sim/contact/impulse_contact.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "sim/collision/entanglement.hpp"

namespace drape {
namespace {

using Index = std::size_t;

constexpr int most_contact_rounds = 10;  // searches for contacts before colliding vertices are held
constexpr int most_impulse_passes = 60;  // per round
constexpr int most_held_rounds = 60;     // rounds after which all zones are joined
constexpr double settled_share = 1e-3;   // convergence tolerance of a pass, as a fraction of the contact distance
constexpr double beyond_share = 1e-2;    // missing distance at which a step falls short, as a fraction of the largest
constexpr double ended_share = 1e-2;  // largest change of a last pass over end velocities, as a fraction of the first's
constexpr double near_share = 0.1;  // largest move of a solve without a new search, as a fraction of the least distance
constexpr double least_correction = 1e-9;  // added to the tolerance of a pass [m]
constexpr double closed_gap = 1e-7;        // largest gap of a weld [m]

/// Returns the convergence tolerance of a contact in a pass [m].
double tolerance_of(const ContactConstraint& contact) {
  return settled_share * (contact.sews ? std::abs(contact.distance) : contact.distance) + least_correction;
}

/// Returns a force across the normal, limited to `most`.
Eigen::Vector3d limited(const Eigen::Vector3d& across, double most) {
  const double size = across.norm();
  return size > most ? Eigen::Vector3d(most / size * across) : across;
}

/// Returns ω with inertia·ω = momentum, without rotation about axes of zero inertia, as for collinear vertices.
Point angular_velocity(const Eigen::Matrix3d& inertia, const Point& momentum) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(inertia);
  const double largest = axes.eigenvalues()[2];
  Point result = Point::Zero();
  for (int k = 0; k < 3; ++k) {
    if (!(axes.eigenvalues()[k] > 1e-9 * largest)) continue;
    const Point axis = axes.eigenvectors().col(k);
    result += axis.dot(momentum) / axes.eigenvalues()[k] * axis;
  }
  return result;
}

/// Moves the vertices of one zone, in ascending order, see move_rigidly.
void move_zone(const std::vector<int>& members, const std::vector<Point>& x, const std::vector<double>& inverse_masses,
               std::vector<Point>& velocities) {
  Point center = Point::Zero(), velocity = Point::Zero(), spin = Point::Zero();
  const auto pin = std::ranges::find_if(members, [&](int v) { return inverse_masses[Index(v)] == 0; });
  if (pin != members.end()) {
    velocity = velocities[Index(*pin)];
  } else {
    double total = 0;
    for (const int v : members) {
      const double mass = 1 / inverse_masses[Index(v)];
      total += mass;
      center += mass * x[Index(v)];
      velocity += mass * velocities[Index(v)];
    }
    center /= total;
    velocity /= total;
    Point angular_momentum = Point::Zero();
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    for (const int v : members) {
      const double mass = 1 / inverse_masses[Index(v)];
      const Point arm = x[Index(v)] - center;
      angular_momentum += mass * arm.cross(velocities[Index(v)] - velocity);
      inertia += mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
    }
    spin = angular_velocity(inertia, angular_momentum);
  }
  for (const int v : members) {
    if (inverse_masses[Index(v)] != 0) velocities[Index(v)] = velocity + spin.cross(x[Index(v)] - center);
  }
}

}  // namespace

void move_rigidly(const std::vector<std::array<int, 4>>& groups, bool all, const std::vector<Point>& x,
                  const std::vector<double>& inverse_masses, std::vector<Point>& velocities) {
  std::vector<int> parent(x.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto& group : groups) {
    for (const int v : group) join_trees(parent, all ? groups.front()[0] : group[0], v);
  }
  std::map<int, std::vector<int>> zones;  // members by their root, which is the smallest
  for (int v = 0; v < static_cast<int>(parent.size()); ++v) {
    const int root = root_of(parent, v);
    if (root != v) zones.try_emplace(root, 1, root).first->second.push_back(v);
  }
  for (const auto& [root, members] : zones) move_zone(members, x, inverse_masses, velocities);
}

ImpulseContact::ImpulseContact(const System& system)
    : sources_(system.contacts), inverse_masses_(inverse_masses(system.cloth)) {
  flight_.gravity = system.gravity;
  flight_.pull = spring_pull(system.springs, system.cloth.masses);
}

void ImpulseContact::begin(const State& state, double) { flight_.start_v = state.v; }

void ImpulseContact::apply(const Vertices& x, double time, double h, Vertices& v) {
  converged_ = true;
  beyond_ = false;
  impulses_.clear();
  x_ = &x;
  flight_.h = h;
  flight_.target = x + h * v;
  if (!flight_.target.allFinite()) return;
  for (const auto& source : sources_) source->begin(x, time, time + h);
  target_ = flight_.target;
  flight_.mean = v;
  find();
  if (!impulses_.empty()) settle(v);
}

bool ImpulseContact::adjust(const Vertices& x, double, double h, Vertices& v) {
  const Vertices own = target_ - flight_.target;
  target_ = x + h * v;
  flight_.target = target_ - own;
  if (!target_.allFinite()) return false;
  flight_.mean = (flight_.target - x) / h;
  find();
  if (!any_violated()) return false;
  settle(v);
  return true;
}

double ImpulseContact::shortfall(const Impulse& impulse, const Eigen::Vector3d& place) {
  return impulse.contact.distance + impulse.bounce.gap - place.dot(impulse.contact.normal);
}

bool ImpulseContact::is_violated(const Impulse& impulse, double tolerance) const {
  const Eigen::Vector3d place = impulse.contact.place(target_);
  return impulse.contact.welds ? place.norm() > closed_gap : shortfall(impulse, place) > tolerance;
}

bool ImpulseContact::any_violated() const {
  return std::ranges::any_of(impulses_, [&](const Impulse& impulse) {
    return impulse.contact.collides || is_violated(impulse, tolerance_of(impulse.contact));
  });
}

bool ImpulseContact::falls_short() const {
  double distance = 0;
  for (const Impulse& impulse : impulses_) distance = std::max(distance, impulse.contact.distance);
  return std::ranges::any_of(impulses_, [&](const Impulse& impulse) {
    return is_violated(impulse, beyond_share * distance + least_correction);
  });
}

void ImpulseContact::settle(Vertices& v) {
  bool found = false, settled = false;
  for (int round = 0; round < most_contact_rounds; ++round) {
    check_stop();
    const bool collided = any_collides();
    before_target_ = target_;
    apply_known();
    settled = solve();
    found = !collided && stays_as_found();
    if (found) break;
    find();
    found = !any_collides();
    if (found) break;
  }
  beyond_ = !settled && falls_short();
  if (!found) hold();
  for (Eigen::Index i = 0; i < v.rows(); ++i) {
    if (target_.row(i) != flight_.target.row(i)) v.row(i) = (target_.row(i) - x_->row(i)) / flight_.h;
  }
}

void ImpulseContact::find() {
  before_.swap(impulses_);
  impulses_.clear();
  found_.clear();
  lost_ = false;
  auto from = before_.begin();
  for (int source = 0; source < static_cast<int>(sources_.size()); ++source) {
    held_.clear();
    for (; from != before_.end() && from->contact.key.source == source; ++from) {
      if (!from->contact.force.isZero(0)) held_.push_back(from->contact);
    }
    sources_[Index(source)]->find(target_, source, held_, found_);
  }
  auto known = before_.begin();
  for (const ContactConstraint& contact : found_) {
    if (!contact.can_move(inverse_masses_)) {
      lost_ = lost_ || contact.is_lost(target_);
      continue;
    }
    Impulse impulse{.contact = contact, .compliance = contact.compliance(inverse_masses_), .bounce = {}};
    impulse.contact.distance = contact.possible_distance();
    while (known != before_.end() && known->contact.key < contact.key) ++known;
    if (known != before_.end() && known->contact.key == contact.key) {
      // Keep the push, along the new normal.
      const Eigen::Vector3d &n = contact.normal, &force = known->contact.force;
      const double normal = force.dot(known->contact.normal);
      impulse.contact.force =
          contact.welds ? known->contact.force
                        : Eigen::Vector3d(normal * n + limited(force - force.dot(n) * n, contact.friction * normal));
    }
    impulse.bounce = bounce_of(contact, flight_);
    impulses_.push_back(impulse);
  }
}

void ImpulseContact::apply_known() {
  target_ = flight_.target;
  for (const Impulse& impulse : impulses_) {
    if (!impulse.contact.force.isZero(0)) impulse.contact.push(inverse_masses_, impulse.contact.force, target_);
  }
}

Eigen::Vector3d ImpulseContact::change_of(const Impulse& impulse, double missing, const Eigen::Vector3d& slip) {
  const ContactConstraint& contact = impulse.contact;
  if (contact.welds) return -slip / impulse.compliance;
  const Eigen::Vector3d& n = contact.normal;
  const double before = contact.force.dot(n);
  if (before == 0 && missing <= 0) return Eigen::Vector3d::Zero();
  const double normal = std::max(0.0, before + missing / impulse.compliance);
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
  if (contact.friction > 0 && normal > 0) {
    across =
        limited(contact.force - before * n - (slip - slip.dot(n) * n) / impulse.compliance, contact.friction * normal);
  }
  return normal * n + across - contact.force;
}

bool ImpulseContact::solve() {
  for (int pass = 0; pass < most_impulse_passes; ++pass) {
    check_stop();
    bool moved = false;
    for (Impulse& impulse : impulses_) {
      ContactConstraint& contact = impulse.contact;
      const Eigen::Vector3d place = contact.place(target_);
      const Eigen::Vector3d slip = contact.welds ? place : Eigen::Vector3d(place - contact.start);
      const Eigen::Vector3d change = change_of(impulse, shortfall(impulse, place), slip);
      if (change.isZero(0)) continue;
      contact.force += change;
      contact.push(inverse_masses_, change, target_);
      if (impulse.compliance * change.norm() > tolerance_of(contact)) moved = true;
    }
    if (!moved) return true;
  }
  return false;
}

bool ImpulseContact::stays_as_found() const {
  double least = std::numeric_limits<double>::infinity();
  for (const Impulse& impulse : impulses_) {
    const ContactConstraint& contact = impulse.contact;
    if (contact.sews) continue;  // always known
    least = std::min(least, contact.distance);
  }
  return (target_ - before_target_).rowwise().squaredNorm().maxCoeff() <= near_share * near_share * least * least;
}

bool ImpulseContact::any_collides() const {
  return std::ranges::any_of(impulses_, [](const Impulse& impulse) { return impulse.contact.collides; });
}

void ImpulseContact::hold() {
  const Index count = inverse_masses_.size();
  std::vector<std::array<int, 4>> joined;
  std::vector<double> inverse_masses = inverse_masses_;
  std::vector<Point> places(count), velocities(count), moved;
  for (Index i = 0; i < count; ++i) {
    places[i] = x_->row(static_cast<Eigen::Index>(i)).transpose();
    velocities[i] = (target_.row(static_cast<Eigen::Index>(i)).transpose() - places[i]) / flight_.h;
  }
  converged_ = false;
  for (int round = 0; any_collides(); ++round) {
    check_stop();
    bool more = false;
    for (const Impulse& impulse : impulses_) {
      if (!impulse.contact.collides) continue;
      if (impulse.contact.count == 4) {
        more = more || std::ranges::find(joined, impulse.contact.vertices) == joined.end();
        joined.push_back(impulse.contact.vertices);
      } else {
        more = hold_with_obstacle(impulse.contact, inverse_masses, velocities) || more;
      }
    }
    if (!more) return;
    moved = velocities;
    move_rigidly(joined, round >= most_held_rounds, places, inverse_masses, moved);
    for (Index i = 0; i < count; ++i) {
      if (inverse_masses_[i] > 0) {
        target_.row(static_cast<Eigen::Index>(i)) = (places[i] + flight_.h * moved[i]).transpose();
      }
    }
    find();
  }
}

bool ImpulseContact::hold_with_obstacle(const ContactConstraint& contact, std::vector<double>& inverse_masses,
                                        std::vector<Point>& velocities) const {
  const double weight = contact.weight();
  bool more = false;
  for (Index i = 0; i < Index(contact.count); ++i) {
    const auto vertex = Index(contact.vertices[i]);
    if (inverse_masses[vertex] == 0) continue;
    inverse_masses[vertex] = 0;
    velocities[vertex] = -contact.carried / (flight_.h * weight);
    more = true;
  }
  return more;
}

void ImpulseContact::finish(Vertices& v) {
  for (const Impulse& impulse : impulses_) {
    const ContactConstraint& contact = impulse.contact;
    if (contact.force.isZero(0) || contact.welds) continue;
    const Eigen::Vector3d& n = contact.normal;
    const Eigen::Vector3d drift = contact.carried / flight_.h, slip = contact.gather(v) + drift;
    const auto change = [&](const Eigen::Vector3d& by) { contact.push(inverse_masses_, by / impulse.compliance, v); };
    if (impulse.bounce.struck > 0) {
      change(change_by(impulse.bounce, contact, slip, impulse.compliance / flight_.h * contact.force));
      continue;
    }
    const double most = std::max(0.0, (contact.gather(flight_.mean) + drift).dot(n)), now = slip.dot(n);
    if (now > most) change((most - now) * n);
  }
  std::erase_if(impulses_,
                [](const Impulse& impulse) { return impulse.contact.force.isZero(0) || impulse.bounce.struck > 0; });
  for (Impulse& impulse : impulses_) impulse.contact.force.setZero();
  double first = 0;  // largest change of a first pass
  for (int pass = 0; pass < most_impulse_passes; ++pass) {
    double most = 0;
    for (Impulse& impulse : impulses_) {
      ContactConstraint& contact = impulse.contact;
      const Eigen::Vector3d speed = contact.gather(v) + contact.carried / flight_.h;
      const Eigen::Vector3d change = change_of(impulse, -speed.dot(contact.normal), speed);
      if (change.isZero(0)) continue;
      contact.force += change;
      contact.push(inverse_masses_, change, v);
      most = std::max(most, impulse.compliance * change.norm());
    }
    if (pass == 0) first = most;
    if (most <= ended_share * first || flight_.h * most <= least_correction) return;
  }
}

}  // namespace drape
