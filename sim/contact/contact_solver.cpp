#include "sim/contact/contact_solver.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <utility>

#include "sim/parallel/vectors.hpp"

namespace drape {
namespace {

using Index = std::size_t;

constexpr double relative_stiffness = 10;      // of a contact, of what holds its vertices otherwise
constexpr double sufficient_decrease = 1e-4;   // Armijo's constant
constexpr double shortest_move = 1e-6;         // of a direction
constexpr double linear_tolerance = 0.05;      // of the residual, of the gradient
constexpr int most_linear_iterations = 300;
constexpr double least_held = 0.1;             // of κ, from which on sliding holds a direction across it
constexpr double least_free = 0.25;      // of a contact's weights, that has to be on free vertices
constexpr double fast = 0.5;  // what an iteration leaves of the gradient at most, unless it creeps
constexpr int most_halvings = 40;
constexpr double worth_an_update = 0.5;  // the largest move of an iteration, of the slack, with which multipliers change

}  // namespace

ContactSolver::ContactSolver(const System& system)
    : system_(system),
      preconditioner_(system.cloth.vertex_count()),
      free_(static_cast<Index>(system.cloth.vertex_count()), 1),
      gradient_(Vertices::Zero(system.cloth.vertex_count(), 3)),
      direction_(gradient_),
      residual_(gradient_),
      preconditioned_(gradient_),
      search_(gradient_),
      product_(gradient_) {
  for (const int pin : system.cloth.pins) free_[static_cast<Index>(pin)] = 0;
  trial_.x = trial_.gradient = gradient_;
}

void ContactSolver::begin(const Vertices& x, double start, double end) {
  contacts_.clear();
  start_ = x;
  for (const auto& source : system_.contacts) source->begin(x, start, end);
}

bool ContactSolver::touches(const Vertices& target) {
  find(target, true);
  return !contacts_.empty();
}

void ContactSolver::find(const Vertices& target, bool turn) {
  before_.swap(contacts_);
  contacts_.clear();
  auto from = before_.begin();
  for (int source = 0; source < static_cast<int>(system_.contacts.size()); ++source) {
    held_.clear();
    for (; from != before_.end() && from->key.source == source; ++from) {
      if (!from->force.isZero(0)) held_.push_back(*from);
    }
    system_.contacts[static_cast<Index>(source)]->find(target, source, held_, contacts_);
  }
  std::erase_if(contacts_, [&](const ContactConstraint& contact) {
    double moved = 0, all = 0;
    for (Index i = 0; i < static_cast<Index>(contact.count); ++i) {
      all += std::abs(contact.weights[i]);
      if (free_[static_cast<Index>(contact.vertices[i])] != 0) moved += std::abs(contact.weights[i]);
    }
    return moved < least_free * all || moved == 0;
  });
  auto known = before_.begin();
  for (ContactConstraint& contact : contacts_) {
    while (known != before_.end() && known->key < contact.key) ++known;
    if (known == before_.end() || known->key != contact.key) continue;
    if (!turn) {
      const bool collides = contact.collides;
      contact = *known;
      contact.collides = collides;
      continue;
    }
    contact.force = known->force;
    contact.stiffness = known->stiffness;
    contact.radius = known->radius;
  }
}

void ContactSolver::set_stiffness(const ContactProblem& problem) {
  for (ContactConstraint& contact : contacts_) {
    if (contact.stiffness > 0) continue;
    double compliance = 0;
    for (Index i = 0; i < static_cast<Index>(contact.count); ++i) {
      const int vertex = contact.vertices[i];
      if (free_[static_cast<Index>(vertex)] == 0) continue;
      compliance += contact.weights[i] * contact.weights[i] / problem.stiffness(vertex, contact.normal);
    }
    contact.stiffness = relative_stiffness / compliance;
  }
}

ContactSolver::Response ContactSolver::respond(const ContactConstraint& contact, const Vertices& x, double radius) const {
  const Eigen::Vector3d& n = contact.normal;
  const Eigen::Vector3d place = contact.place(x), slip = place - contact.start;
  const double k = contact.stiffness, before = contact.force.dot(n);
  const double normal = std::max(0.0, before - k * (place.dot(n) - contact.distance));
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
  response.residual = (response.force - contact.force).norm() / k;
  return response;
}

void ContactSolver::find_radii(const Vertices& x, bool all) {
  for (ContactConstraint& contact : contacts_) {
    if (!all && contact.radius >= 0) continue;
    const double gap = contact.place(x).dot(contact.normal) - contact.distance;
    contact.radius = contact.friction * std::max(0.0, contact.force.dot(contact.normal) - contact.stiffness * gap);
  }
}

double ContactSolver::add_forces(const Vertices& x, Vertices& gradient) {
  double energy = 0;
  responses_.resize(contacts_.size());
  for (Index k = 0; k < contacts_.size(); ++k) {
    responses_[k] = respond(contacts_[k], x, contacts_[k].radius);
    contacts_[k].scatter(-responses_[k].force, gradient);
    energy += responses_[k].energy;
  }
  for (const int pin : system_.cloth.pins) gradient.row(pin).setZero();
  return energy;
}

void ContactSolver::find_direction(ContactProblem& problem, const Vertices& x, const Vertices& gradient,
                                   Vertices& direction) {
  const Threads& threads = system_.threads;
  NewtonCholesky* factor = problem.factor();
  std::vector<ContactBlock> absorbed;
  std::vector<char> in_factor(contacts_.size(), 0);
  if (factor != nullptr) {
    for (Index k = 0; k < contacts_.size(); ++k) {
      const ContactConstraint& contact = contacts_[k];
      if (responses_[k].stiffness.isZero(0)) continue;
      ContactBlock block{contact.count, contact.vertices, contact.weights, responses_[k].stiffness};
      if (!factor->couples(block)) continue;
      in_factor[k] = 1;
      absorbed.push_back(block);
    }
    const bool all = std::ranges::count(in_factor, 1) == std::ranges::count_if(responses_, [](const Response& r) { return !r.stiffness.isZero(0); });
    factor->set_contacts(std::move(absorbed));
    factor->set_damping(damping_);
    factor->begin();
    factor->solve(x, gradient, concavity_, direction);
    linear_iterations_ = 1;
    if (all) return;
    problem.linearise(x, factor->share(), damping_);
  }
  std::vector<HeldDirection> held;
  for (Index k = 0; k < contacts_.size(); ++k) {
    if (in_factor[k] != 0) continue;
    const ContactConstraint& contact = contacts_[k];
    const Response& response = responses_[k];
    const double all = contact.stiffness * (1 + 1 / relative_stiffness);
    const auto hold = [&](const Eigen::Vector3d& u) {
      const double stiffness = u.dot(response.stiffness * u);
      if (stiffness < least_held * contact.stiffness) return;
      held.push_back({static_cast<int>(k), u, all - contact.stiffness + stiffness});
    };
    hold(contact.normal);
    if (contacts_[k].radius == 0) continue;
    Eigen::Vector3d first = response.force - response.force.dot(contact.normal) * contact.normal;
    if (response.sticks || first.isZero(0)) first = contact.normal.unitOrthogonal();
    first.normalize();
    hold(first);
    hold(contact.normal.cross(first));
  }
  preconditioner_.set(contacts_, std::move(held), free_);
  const auto solve = [&](const Vertices& a, Vertices& b) {
    if (factor != nullptr) {
      factor->solve_again(a, b);
    } else {
      problem.precondition(a, b);
    }
  };
  direction.setZero();
  residual_ = gradient;
  double energy = 0, first_energy = 0;
  for (int iteration = 0; iteration < most_linear_iterations; ++iteration) {
    linear_iterations_ = iteration;
    system_.stop.look();
    preconditioner_.apply(residual_, preconditioned_, solve);
    const double before = energy;
    energy = dot(threads, residual_, preconditioned_);
    if (iteration == 0) {
      first_energy = energy;
      search_ = preconditioned_;
    } else {
      multiply_and_add(threads, energy / before, preconditioned_, search_);
    }
    if (!(energy > linear_tolerance * linear_tolerance * first_energy)) break;
    problem.multiply(search_, product_);
    for (Index k = 0; k < contacts_.size(); ++k) {
      const Eigen::Vector3d moved = contacts_[k].gather(search_);
      contacts_[k].scatter(responses_[k].stiffness * moved, product_);
    }
    for (const int pin : system_.cloth.pins) product_.row(pin).setZero();
    const double curvature = dot(threads, search_, product_);
    if (!(curvature > 0)) {
      // As far as H is positive definite it has been solved (Nocedal and Wright 2006, algorithm 7.1).
      if (iteration == 0) direction = preconditioned_;
      return;
    }
    const double length = energy / curvature;
    if (!std::isfinite(length)) return;
    add_multiple(threads, length, search_, direction);
    add_multiple(threads, -length, product_, residual_);
  }
}

double ContactSolver::descend(ContactProblem& problem, Iterate& point, double value, double slope) {
  for (double length = 1; length >= shortest_move; length /= 2) {
    system_.stop.look();
    sum(system_.threads, point.x, -length, direction_, trial_.x);
    trial_.value = problem.evaluate(trial_.x, trial_.gradient);
    double after = trial_.value;
    for (Index k = 0; k < contacts_.size(); ++k) after += respond(contacts_[k], trial_.x, contacts_[k].radius).energy;
    if (after <= value - sufficient_decrease * length * slope + problem.rounding(std::abs(value))) {
      std::swap(point, trial_);
      return length;
    }
  }
  return 0;
}

StepReport ContactSolver::solve(ContactProblem& problem, double given, int most_iterations, Iterate& point) {
  StepReport report;
  report.converged = false;
  bool settled = false, updated = false;
  double last_steepness = 0;
  concavity_ = damping_ = 0;
  for (;; ++report.iterations) {
    problem.linearise(point.x, 0, damping_);
    set_stiffness(problem);
    find_radii(point.x, updated);
    gradient_ = point.gradient;
    const double value = point.value + add_forces(point.x, gradient_);
    const double way = (point.x - start_).rowwise().norm().maxCoeff();
    static const double share = getenv("SHARE") ? atof(getenv("SHARE")) : 0.01;
    const double tolerance = std::max(given, share * way);
    double residual = 0;
    bool collides = false;
    for (Index k = 0; k < contacts_.size(); ++k) {
      residual = std::max(residual, responses_[k].residual);
      collides = collides || contacts_[k].collides;
    }
    const double error = problem.error(gradient_);
    if (std::getenv("DRAPE_CT")) std::fprintf(stderr, "  it %d contacts %zu residual %.3g error %.3g collides %d value %.8g\n", report.iterations, contacts_.size(), residual, error, (int)collides, value);
    if (residual <= tolerance && (error <= tolerance || settled) && !collides) {
      report.converged = true;
      break;
    }
    if (report.iterations >= most_iterations || !std::isfinite(value)) break;
    const double steepness = norm(system_.threads, gradient_);
    if (report.iterations > 0 && !updated && steepness > fast * last_steepness) concavity_ = 1;
    last_steepness = steepness;
    find_direction(problem, point.x, gradient_, direction_);
    const double slope = dot(system_.threads, gradient_, direction_);
    const double length = descend(problem, point, value, slope);
    if (length == 0 && !collides) { if (std::getenv("DRAPE_CT")) std::fprintf(stderr, "  line search failed slope %.3g\n", slope); break; }
    const double moved = direction_.rowwise().norm().maxCoeff();
    settled = moved <= tolerance;
    double slack = 0;
    for (Index k = 0; k < contacts_.size(); ++k) {
      slack = std::max(slack, respond(contacts_[k], point.x, contacts_[k].radius).residual);
    }
    if (std::getenv("DRAPE_CT")) std::fprintf(stderr, "     pcg %d theta %g length %g moved %.3g slack %.3g\n", linear_iterations_, damping_, length, moved, slack);
    if (length < 0.5) damping_ = std::min(1.0, std::max(4 * damping_, 1.0 / 256));
    if (length == 1) damping_ = damping_ < 1e-3 ? 0 : damping_ / 4;
    updated = false;
    if (moved <= std::max(tolerance, worth_an_update * slack)) {
      for (Index k = 0; k < contacts_.size(); ++k) {
        contacts_[k].force = respond(contacts_[k], point.x, contacts_[k].radius).force;
      }
      updated = true;
    }
    find(point.x, updated);
  }
  retreat(problem, point);
  return report;
}

void ContactSolver::retreat(ContactProblem& problem, Iterate& point) {
  const auto collides = [&] {
    return std::ranges::any_of(contacts_, [](const ContactConstraint& contact) { return contact.collides; });
  };
  if (!collides()) return;
  const Vertices way = point.x - start_;
  double part = 1;
  for (int halving = 0; halving < most_halvings && collides(); ++halving) {
    part /= 2;
    point.x = start_ + part * way;
    find(point.x, true);
  }
  point.value = problem.evaluate(point.x, point.gradient);
}

double ContactSolver::work_of_obstacles() const {
  double work = 0;
  for (const ContactConstraint& contact : contacts_) work -= contact.force.dot(contact.carried);
  return work;
}

bool ContactSolver::carried() const {
  return std::ranges::any_of(contacts_, [](const ContactConstraint& contact) { return !contact.carried.isZero(0); });
}

void ContactSolver::rebound(const Vertices& before, double h, Vertices& v) const {
  for (const ContactConstraint& contact : contacts_) {
    if (!(contact.restitution > 0) || !(contact.force.dot(contact.normal) > 0)) continue;
    const Eigen::Vector3d drift = contact.carried / h;
    const double arriving = (contact.gather(before) + drift).dot(contact.normal);
    const double leaving = (contact.gather(v) + drift).dot(contact.normal);
    if (!(arriving < 0) || leaving >= -contact.restitution * arriving) continue;
    double compliance = 0;
    for (Index i = 0; i < static_cast<Index>(contact.count); ++i) {
      const int vertex = contact.vertices[i];
      if (free_[static_cast<Index>(vertex)] == 0) continue;
      compliance += contact.weights[i] * contact.weights[i] / system_.cloth.masses[vertex];
    }
    const double impulse = (-contact.restitution * arriving - leaving) / compliance;
    for (Index i = 0; i < static_cast<Index>(contact.count); ++i) {
      const int vertex = contact.vertices[i];
      if (free_[static_cast<Index>(vertex)] == 0) continue;
      v.row(vertex) += contact.weights[i] * impulse / system_.cloth.masses[vertex] * contact.normal.transpose();
    }
  }
}

}  // namespace drape
