#include "sim/contact/contact_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/parallel/vectors.hpp"

namespace drape {
namespace {

using Index = std::size_t;

constexpr double relative_stiffness = 10;     // κ, in multiples of the stiffness of a contact's vertices
constexpr double weld_stiffness = 100;        // κ of a weld, likewise; it never opens
constexpr double length_stiffness = 100;      // κ of an edge at its strain limit or of a rope, likewise
constexpr double length_share = 0.5;          // largest gap of a length in the solve, relative to the allowed one
constexpr double sufficient_decrease = 1e-4;  // Armijo's constant (Nocedal and Wright 2006, section 3.1)
constexpr double shortest_move = 1e-6;        // least step length along a direction
constexpr double share_of_change = 0.01;      // tolerance, relative to the largest displacement by forces
constexpr double begins_on = 0.01;            // largest gap at the start of a contact, relative to the distance
constexpr double share_of_way = 1e-6;         // least tolerance, relative to the largest displacement
constexpr double gap_share = 0.2;          // limit of gaps, relative to that of slips, as κ makes large forces of them
constexpr double linear_tolerance = 0.05;  // of conjugate gradients, in the preconditioner's norm
constexpr int most_linear_iterations = 300;
constexpr double least_held = 0.1;       // fraction of κ from which a direction counts as constrained
constexpr double worth_an_update = 0.5;  // largest move, as a fraction of the slack, at which multipliers change
constexpr std::size_t depth = 3;         // of the acceleration of multipliers
constexpr int plain_updates = 10;  // before it begins: most steps need no more, and acceleration takes longer there
constexpr double fast = 0.5;       // gradient norm ratio of iterations above which the full Hessian is used
constexpr double least_damping = 1.0 / 256, damping_growth = 4;
constexpr int most_halvings = 40, most_rounds = 50;
constexpr int most_useful = 150;  // iterations; a step that needs more rarely converges

double longest(const Vertices& v) { return v.rowwise().norm().maxCoeff(); }

/// Returns true if the features begin the step at the contact's distance or nearer.
bool begins_closed(const ContactConstraint& contact) {
  return contact.start.dot(contact.normal) < (1 + begins_on) * contact.distance;
}

/// Returns true for an edge at its strain limit: it has a tolerance of its own, and touches nothing.
bool limits_strain(const ContactConstraint& contact) { return contact.law == ContactLaw::length && !contact.sews; }

}  // namespace

ContactSolver::ContactSolver(const System& system)
    : system_(system),
      preconditioner_(system.cloth.vertex_count()),
      inverse_masses_(inverse_masses(system.cloth)),
      acceleration_(depth),
      gradient_(Vertices::Zero(system.cloth.vertex_count(), 3)),
      direction_(gradient_),
      residual_(gradient_),
      preconditioned_(gradient_),
      search_(gradient_),
      product_(gradient_) {
  flight_.pull = spring_pull(system.springs, system.cloth.masses);
  trial_.x = trial_.gradient = gradient_;
  for (const Spring& spring : system.cloth.springs) {
    longest_move_ += spring.rest_length / static_cast<double>(system.cloth.springs.size());
  }
  if (system.cloth.springs.empty()) longest_move_ = std::numeric_limits<double>::infinity();
}

void ContactSolver::begin(const State& from, double start, double end, bool instantaneous) {
  contacts_.clear();
  with_limits_ = false;
  const Vertices& x = start_ = from.x;
  flight_.h = end - start;
  flight_.gravity = system_.gravity;
  flight_.start_v = from.v;
  flight_.mean = from.v.rowwise() + (instantaneous ? 0.5 : 1.0) * flight_.h * system_.gravity.transpose();
  flight_.target = x + flight_.h * flight_.mean;
  for (const auto* sources : {&system_.contacts, &system_.limits}) {
    for (const auto& source : *sources) source->begin(start_, start, end);
  }
}

ContactSource& ContactSolver::source(int number) const {
  const auto k = static_cast<Index>(number), others = system_.contacts.size();
  return k < others ? *system_.contacts[k] : *system_.limits[k - others];
}

void ContactSolver::expect(const std::vector<ContactForce>& forces) {
  contacts_.clear();
  for (const ContactForce& last : forces) {
    const auto& [source, kind, a, b, c, d] = last.key;
    ContactConstraint contact;
    contact.key = {source, kind, {a, b, c, d}};
    contact.force = last.force;
    contacts_.push_back(contact);
  }
}

std::vector<ContactForce> ContactSolver::forces() const {
  std::vector<ContactForce> forces;
  for (const ContactConstraint& contact : contacts_) {
    const auto& [a, b, c, d] = contact.key.features;
    const ContactForce force{{contact.key.source, contact.key.kind, a, b, c, d}, contact.force};
    if (contact.force.isZero(0)) continue;
    if (contact.law == ContactLaw::length) {
      forces.push_back(force);
      continue;
    }
    if (!exact_ || contact.welds || contact.friction <= 0 || !begins_closed(contact)) continue;
    forces.push_back(force);
  }
  return forces;
}

namespace {

/// Returns the part of a force that a contact can bear: a push along its normal, and friction within Coulomb's cone.
Eigen::Vector3d bearable(const ContactConstraint& contact, const Eigen::Vector3d& force) {
  const double normal = std::max(0.0, force.dot(contact.normal));
  const Eigen::Vector3d across = force - force.dot(contact.normal) * contact.normal;
  const double most = contact.friction * normal, size = across.norm();
  return normal * contact.normal + (size > most ? most / size : 1.0) * across;
}

}  // namespace

bool ContactSolver::touches(const Vertices& target) {
  find(target, true);
  return !contacts_.empty();
}

bool ContactSolver::is_blocked(const Vertices& target) {
  find(target, true);
  return std::ranges::any_of(contacts_, [&](const ContactConstraint& contact) {
    if (limits_strain(contact)) return false;
    return contact.collides || contact.welds || contact.place(target).dot(contact.normal) < contact.distance ||
           begins_closed(contact);
  });
}

bool ContactSolver::collides(const Vertices& target) {
  find(target, true);
  return any_collides();
}

bool ContactSolver::any_collides() const {
  return std::ranges::any_of(contacts_, [](const ContactConstraint& contact) { return contact.collides; });
}

void ContactSolver::find(const Vertices& target, bool turn) {
  if (!target.allFinite()) return;
  before_.swap(contacts_);
  contacts_.clear();
  lost_ = false;
  auto from = before_.begin();
  const auto others = static_cast<int>(system_.contacts.size()), limits = static_cast<int>(system_.limits.size());
  for (int number = 0; number < others + limits; ++number) {
    if (number == others && contacts_.empty() && !with_limits_) break;
    held_.clear();
    for (; from != before_.end() && from->key.source == number; ++from) {
      if (!from->force.isZero(0) || from->beyond > 0) held_.push_back(*from);
    }
    const auto earlier = std::ssize(contacts_);
    source(number).find(target, number, held_, contacts_);
    const auto cannot_move = [&](const ContactConstraint& contact) {
      if (contact.can_move(inverse_masses_)) return false;
      lost_ = lost_ || contact.is_lost(target);
      return true;
    };
    contacts_.erase(std::remove_if(contacts_.begin() + earlier, contacts_.end(), cannot_move), contacts_.end());
  }
  auto known = before_.begin();
  for (ContactConstraint& contact : contacts_) {
    contact.beyond = bounce_of(contact, flight_).gap;
    while (known != before_.end() && known->key < contact.key) ++known;
    if (known == before_.end() || known->key != contact.key) continue;
    if (turn) {
      contact.force = known->force;
      contact.stiffness = known->stiffness;
      contact.radius = known->radius;
      if (known->stiffness > 0 || known->force.isZero(0)) continue;
      contact.force = bearable(contact, known->force);  // from the last step
      contact.radius = contact.friction * std::max(0.0, contact.force.dot(contact.normal));
    } else {
      const bool collides = contact.collides;
      contact = *known;
      contact.collides = collides;
    }
  }
}

void ContactSolver::set_stiffness(const ContactProblem& problem) {
  for (ContactConstraint& contact : contacts_) {
    if (contact.stiffness > 0) continue;
    double compliance = 0;
    for (Index i = 0; i < static_cast<Index>(contact.count); ++i) {
      const int vertex = contact.vertices[i];
      if (inverse_masses_[static_cast<Index>(vertex)] == 0) continue;
      compliance += contact.weights[i] * contact.weights[i] / problem.stiffness(vertex, contact.normal);
    }
    const double ratio = contact.welds                       ? weld_stiffness
                         : contact.law == ContactLaw::length ? length_stiffness
                                                             : relative_stiffness;
    contact.stiffness = ratio / compliance;
  }
}

ContactSolver::Response ContactSolver::respond_to_length(const ContactConstraint& contact, const Vertices& x) {
  const Eigen::Vector3d place = contact.place(x);
  const double size = place.norm(), k = contact.stiffness, before = contact.force.norm();
  const bool pulls = contact.distance < 0;
  const Eigen::Vector3d n = size > 0 ? Eigen::Vector3d((pulls ? -1 : 1) / size * place) : contact.normal;
  const double force = std::max(0.0, before - k * ((pulls ? -size : size) - contact.distance));
  Response response{.force = force * n,
                    .stiffness = Eigen::Matrix3d::Zero(),
                    .energy = (force * force - before * before) / (2 * k),
                    .residual = std::abs(force - before) / k};
  if (force == 0) return response;
  response.stiffness = k * n * n.transpose();
  // Across, a push has a negative stiffness, which is left out.
  if (pulls) response.stiffness += force / size * (Eigen::Matrix3d::Identity() - n * n.transpose());
  return response;
}

ContactSolver::Response ContactSolver::respond(const ContactConstraint& contact, const Vertices& x) const {
  if (contact.law == ContactLaw::length) return respond_to_length(contact, x);
  const Eigen::Vector3d& n = contact.normal;
  const Eigen::Vector3d place = contact.place(x), slip = place - contact.start;
  const double k = contact.stiffness, before = contact.force.dot(n), radius = contact.radius;
  if (contact.welds) {
    const Eigen::Vector3d force = contact.force - k * place;
    return {.force = force,
            .stiffness = k * Eigen::Matrix3d::Identity(),
            .energy = (force.squaredNorm() - contact.force.squaredNorm()) / (2 * k),
            .residual = place.norm(),
            .sticks = true};
  }
  const double normal = std::max(0.0, before - k * (place.dot(n) - contact.distance - contact.beyond));
  Response response;
  response.force = normal * n;
  response.stiffness.setZero();
  response.energy = (normal * normal - before * before) / (2 * k);
  if (normal > 0) response.stiffness = k * n * n.transpose();
  if (radius > 0) {
    const Eigen::Vector3d pull = (contact.force - before * n) - k * (slip - slip.dot(n) * n);
    const double size = pull.norm();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - n * n.transpose();
    response.sticks = size <= radius;
    if (response.sticks) {
      response.force += pull;
      response.energy += size * size / (2 * k);
      response.stiffness += k * across;
    } else {
      const Eigen::Vector3d along = pull / size;
      response.force += radius * along;
      response.energy += radius * (size - radius / 2) / k;
      response.stiffness += k * radius / size * (across - along * along.transpose());
    }
  }
  const Eigen::Vector3d change = response.force - contact.force;
  const double along = change.dot(n);
  response.residual = std::max(std::abs(along), gap_share * (change - along * n).norm()) / k;
  return response;
}

void ContactSolver::find_radii(const Vertices& x, bool all) {
  for (ContactConstraint& contact : contacts_) {
    if (!all && contact.radius >= 0) continue;
    // The first depth of features that meet in the step says little of their force.
    if (!all && !begins_closed(contact) && contact.force.isZero(0)) {
      contact.radius = 0;
      continue;
    }
    const double gap = contact.place(x).dot(contact.normal) - contact.distance - contact.beyond;
    contact.radius = contact.friction * std::max(0.0, contact.force.dot(contact.normal) - contact.stiffness * gap);
  }
}

ContactSolver::PointStatus ContactSolver::assess(const ContactProblem& problem, const Iterate& point) {
  gradient_ = point.gradient;
  responses_.resize(contacts_.size());
  PointStatus now{.value = point.value, .residual = 0, .open = 0, .error = 0, .collides = false};
  for (Index k = 0; k < contacts_.size(); ++k) {
    responses_[k] = respond(contacts_[k], point.x);
    contacts_[k].scatter(-responses_[k].force, gradient_);
    now.value += responses_[k].energy;
    const double residual = responses_[k].residual;
    if (limits_strain(contacts_[k])) {
      now.open = std::max(now.open, residual / (length_share * contacts_[k].most_open));
    } else {
      now.residual = std::max(now.residual, residual);
      if (contacts_[k].welds) now.open = std::max(now.open, residual / ContactConstraint::most_open_weld);
    }
    now.collides = now.collides || contacts_[k].collides;
  }
  for (const int pin : system_.cloth.pins) gradient_.row(pin).setZero();
  now.error = problem.error(gradient_);
  return now;
}

bool ContactSolver::solve_with_factor(NewtonCholesky& factor, const Vertices& x) {
  std::vector<ContactBlock> blocks;
  for (Index k = 0; k < contacts_.size(); ++k) {
    const ContactConstraint& contact = contacts_[k];
    blocks.push_back({contact.count, contact.vertices, contact.weights, responses_[k].stiffness});
  }
  if (!factor.set_contacts(std::move(blocks))) return false;
  factor.begin();
  factor.solve(x, gradient_, concavity_, direction_);
  return true;
}

std::vector<HeldDirection> ContactSolver::held_directions() const {
  std::vector<HeldDirection> held;
  for (Index k = 0; k < contacts_.size(); ++k) {
    const ContactConstraint& contact = contacts_[k];
    const Response& response = responses_[k];
    const auto hold = [&](const Eigen::Vector3d& u) {
      const double stiffness = u.dot(response.stiffness * u);
      if (stiffness < least_held * contact.stiffness) return;
      held.push_back({static_cast<int>(k), u, stiffness + contact.stiffness / relative_stiffness});
    };
    if (contact.welds) {
      for (int axis = 0; axis < 3; ++axis) hold(Eigen::Vector3d::Unit(axis));
      continue;
    }
    hold(contact.normal);
    if (contact.radius <= 0) continue;
    Eigen::Vector3d first = response.force - response.force.dot(contact.normal) * contact.normal;
    if (response.sticks || first.isZero(0)) first = contact.normal.unitOrthogonal();
    first.normalize();
    hold(first);
    hold(contact.normal.cross(first));
  }
  return held;
}

void ContactSolver::find_direction(ContactProblem& problem, const Vertices& x) {
  NewtonCholesky* const factor = problem.factor();
  if (factor != nullptr && solve_with_factor(*factor, x)) return;
  preconditioner_.set(contacts_, held_directions(), inverse_masses_);
  iterate_linearly(problem);
}

void ContactSolver::iterate_linearly(ContactProblem& problem) {
  const Threads& threads = system_.threads;
  direction_.setZero();
  residual_ = gradient_;
  double energy = 0, first = 0;
  for (int iteration = 0; iteration < most_linear_iterations; ++iteration) {
    system_.stop.check();
    preconditioner_.apply(residual_, preconditioned_,
                          [&](const Vertices& a, Vertices& b) { problem.precondition(a, b); });
    const double before = energy;
    energy = dot(threads, residual_, preconditioned_);
    if (iteration == 0) {
      first = energy;
      search_ = preconditioned_;
    } else {
      multiply_and_add(threads, energy / before, preconditioned_, search_);
    }
    if (!(energy > linear_tolerance * linear_tolerance * first)) return;
    problem.multiply(search_, product_);
    for (Index k = 0; k < contacts_.size(); ++k) {
      contacts_[k].scatter(responses_[k].stiffness * contacts_[k].gather(search_), product_);
    }
    for (const int pin : system_.cloth.pins) product_.row(pin).setZero();
    const double curvature = dot(threads, search_, product_);
    if (!(curvature > 0)) {
      // Conjugate gradients have solved it as far as the Hessian is positive definite (Nocedal and Wright 2006,
      // algorithm 7.1).
      if (iteration == 0) direction_ = preconditioned_;
      return;
    }
    add_multiple(threads, energy / curvature, search_, direction_);
    add_multiple(threads, -energy / curvature, product_, residual_);
  }
}

double ContactSolver::descend(ContactProblem& problem, Iterate& point, double value) {
  const double slope = dot(system_.threads, gradient_, direction_);
  const double first = std::min(1.0, longest_move_ / longest(direction_));
  for (double length = first; length >= shortest_move; length /= 2) {
    system_.stop.check();
    sum(system_.threads, point.x, -length, direction_, trial_.x);
    trial_.value = problem.evaluate(trial_.x, trial_.gradient);
    double after = trial_.value;
    for (const ContactConstraint& contact : contacts_) after += respond(contact, trial_.x).energy;
    if (after <= value - sufficient_decrease * length * slope + problem.rounding(value)) {
      std::swap(point, trial_);
      return length;
    }
  }
  return 0;
}

void ContactSolver::choose_start(ContactProblem& problem, const Vertices& steady, Iterate& point) {
  steady_ = steady;
  const auto value_of = [&](const Iterate& at) {
    problem.linearise(at.x, 0, 0);
    set_stiffness(problem);
    find_radii(at.x, false);
    return assess(problem, at).value;
  };
  double value = value_of(point);
  const auto consider = [&](const Vertices& x) {
    trial_.x = x;
    for (const int pin : system_.cloth.pins) trial_.x.row(pin) = steady.row(pin);
    trial_.value = problem.evaluate(trial_.x, trial_.gradient);
    find(trial_.x, true);
    const double other = value_of(trial_);
    if (!(other < value)) return;
    value = other;
    std::swap(point, trial_);
  };
  consider(steady);
  if (problem.exact()) consider(start_);
  find(point.x, true);
}

StepReport ContactSolver::solve(ContactProblem& problem, const Accuracy& accuracy, int most_iterations,
                                Iterate& point) {
  StepReport report;
  report.converged = false;
  bool settled = false, updated = false;
  double steepness = 0, moved = std::numeric_limits<double>::infinity();
  concavity_ = damping_ = 0;
  exact_ = problem.exact();
  problem.forget_contacts();
  acceleration_.restart();
  updates_ = 0;
  for (;; ++report.iterations) {
    problem.linearise(point.x, 0, damping_);
    set_stiffness(problem);
    find_radii(point.x, updated);
    const PointStatus now = assess(problem, point);
    const bool by_gradient = accuracy.rule == StoppingRule::gradient;
    const double by_motion = accuracy.is_default || by_gradient ? std::max(share_of_change * longest(point.x - steady_),
                                                                           share_of_way * longest(point.x - start_))
                                                                : 0;
    const double tolerance = tolerance_ = by_gradient ? by_motion : std::max(accuracy.tolerance, by_motion);
    const bool at_a_change = problem.exact() || accuracy.rule == StoppingRule::change;
    const bool balanced = by_gradient ? norm(system_.threads, gradient_) <= accuracy.tolerance
                                      : now.error <= tolerance || (settled && at_a_change);
    report.converged = balanced && now.residual <= gap_share * tolerance && now.open <= 1 && !now.collides;
    if (report.converged || report.iterations >= std::min(most_iterations, most_useful) || !std::isfinite(now.value))
      break;
    const double before = std::exchange(steepness, norm(system_.threads, gradient_));
    if (report.iterations > 0 && !updated && steepness > fast * before) concavity_ = 1;
    find_direction(problem, point.x);
    const double length = descend(problem, point, now.value);
    if (length == 0 && !now.collides) break;
    if (length < 0.5) damping_ = std::min(1.0, std::max(damping_growth * damping_, least_damping));
    if (length == 1) damping_ = damping_ <= least_damping ? 0 : damping_ / damping_growth;
    const double step = longest(direction_);
    if (problem.exact()) moved = step;
    settled = step <= tolerance;
    updated = step <= std::max(tolerance, worth_an_update * slack(point.x));
    // The point is no minimum for multipliers that are extrapolated.
    if (updated && update_multipliers(point.x)) settled = false;
    find(point.x, updated);
  }
  retreat(problem, point);
  error_ = std::min(assess(problem, point).error, moved);
  return report;
}

double ContactSolver::slack(const Vertices& x) const {
  double most = 0;
  for (const ContactConstraint& contact : contacts_) most = std::max(most, respond(contact, x).residual);
  return most;
}

bool ContactSolver::update_multipliers(const Vertices& x) {
  std::vector<Index> bearing;
  std::vector<ContactKey> keys;
  for (Index k = 0; k < contacts_.size(); ++k) {
    responses_[k] = respond(contacts_[k], x);
    if (responses_[k].force.isZero(0) && contacts_[k].force.isZero(0)) continue;
    bearing.push_back(k);
    keys.push_back(contacts_[k].key);
  }
  if (bearing.empty()) return false;
  Eigen::Matrix3Xd before(3, std::ssize(bearing)), forces = before, weights = before;
  for (Eigen::Index i = 0; i < forces.cols(); ++i) {
    const Index k = bearing[static_cast<Index>(i)];
    before.col(i) = contacts_[k].force;
    forces.col(i) = responses_[k].force;
    weights.col(i).setConstant(1 / contacts_[k].stiffness);
  }
  if (keys != bearing_) acceleration_.restart();
  bearing_ = std::move(keys);
  Eigen::VectorXd next = forces.reshaped();
  if (exact_) next = acceleration_.next(before.reshaped(), next, weights.reshaped());
  const bool accelerated = ++updates_ > plain_updates && next != forces.reshaped();
  for (Index i = 0; i < bearing.size(); ++i) {
    ContactConstraint& contact = contacts_[bearing[i]];
    const Eigen::Vector3d force = next.segment<3>(3 * static_cast<Eigen::Index>(i));
    contact.force = !accelerated ? responses_[bearing[i]].force : contact.welds ? force : bearable(contact, force);
  }
  return accelerated;
}

void ContactSolver::move_with_obstacles(Vertices& x) {
  std::vector<char> moved(inverse_masses_.size(), 0);
  const auto move = [&](const ContactConstraint& contact, const Eigen::RowVector3d& way, bool again) {
    for (Index i = 0; i < static_cast<Index>(contact.count); ++i) {
      const auto vertex = static_cast<Index>(contact.vertices[i]);
      if (inverse_masses_[vertex] == 0 || (moved[vertex] != 0 && !again)) continue;
      x.row(contact.vertices[i]) = start_.row(contact.vertices[i]) + way;
      moved[vertex] = 1;
    }
  };
  for (int round = 0; round < most_rounds && carried() && any_collides(); ++round) {
    for (const ContactConstraint& contact : contacts_) {
      if (!contact.collides) continue;
      if (contact.with_obstacle()) {
        move(contact, -contact.carried.transpose() / contact.weight(), true);
        continue;
      }
      const auto first = contact.vertices.begin(), last = first + contact.count;
      const auto taken = std::find_if(first, last, [&](int v) { return moved[static_cast<Index>(v)] != 0; });
      if (taken != last) move(contact, x.row(*taken) - start_.row(*taken), false);
    }
    find(x, true);
  }
}

void ContactSolver::retreat(ContactProblem& problem, Iterate& point) {
  if (!any_collides()) return;
  move_with_obstacles(point.x);
  Vertices back = start_;
  for (const int pin : system_.cloth.pins) back.row(pin) = point.x.row(pin);
  if (any_collides() && carried()) {
    // An obstacle may have moved beyond the start.
    find(back, true);
    move_with_obstacles(back);
    find(point.x, true);
  }
  const Vertices way = point.x - back;
  double part = 1;
  for (int halving = 0; halving <= most_halvings && any_collides(); ++halving) {
    part = halving < most_halvings ? part / 2 : 0;
    point.x = back + part * way;
    find(point.x, true);
  }
  point.value = problem.evaluate(point.x, point.gradient);
}

}  // namespace drape
