#include "sim/schemes/energy_balance.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "sim/dashpots.hpp"
#include "sim/parallel/loops.hpp"

namespace drape {
namespace {

// Fraction of the forces' largest work, see EnergyBalance. The homework's loosest tolerance gains up to 0.081 of it and
// still stops after two iterations.
constexpr double tolerated_share = 0.1;
constexpr double least_kept = 1e-10;
// Fraction of the kinetic energy that is noticed in steps with contact: velocities are differences of rounded
// positions.
constexpr double noticed = 1e-9;
constexpr double much = 0.01;  // see EnergyBalance::gains_much()

/// Returns Σ m a·b over the rows of n×3 expressions.
double inner(const Threads& threads, const Eigen::VectorXd& m, const auto& a, const auto& b) {
  return sum_of(threads, m.size(), [&](Eigen::Index first, Eigen::Index count) {
    const auto part = [&](const auto& column) { return column.segment(first, count).array(); };
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) sum += (part(m) * part(a.col(axis)) * part(b.col(axis))).sum();
    return sum;
  });
}

/// Returns an upper bound on the distance between corresponding vertices: √3 times the largest coordinate difference.
double largest_distance(const Threads& threads, const Vertices& a, const Vertices& b) {
  const double component = reduce(
      threads, a.size(),
      [&](Eigen::Index first, Eigen::Index count) {
        const auto part = [&](const Vertices& v) { return Eigen::Map<const Eigen::ArrayXd>(v.data() + first, count); };
        return (part(a) - part(b)).abs().maxCoeff();
      },
      [](double most, double next) { return std::max(most, next); }, numbers_worth_dividing);
  return std::sqrt(3.0) * component;
}

}  // namespace

Eigen::RowVector3d mean(const Cloth& cloth, const Vertices& v) {
  return (cloth.masses.transpose() * v) / cloth.masses.sum();
}

bool is_free(const System& system) { return system.cloth.pins.empty() && system.drag == nullptr; }

void balance_momentum(const Cloth& cloth, const StepObjective& objective, Iterate& point) {
  const Eigen::RowVector3d shift = mean(cloth, objective.y()) - mean(cloth, point.x);
  const double inertial = objective.inertial_value(point.x);
  point.x.rowwise() += shift;
  point.value += objective.inertial_value(point.x) - inertial;  // translation does not change the energy
  point.gradient.noalias() += objective.inertia() * shift;
}

EnergyBalance::EnergyBalance(const System& system, const StepObjective& objective, const Minimiser& minimiser)
    : system_(system),
      objective_(objective),
      minimiser_(minimiser),
      steady_(system.pin_motions.empty() && system.drag == nullptr),
      springs_(system.energies.empty()) {}

void EnergyBalance::begin(const State& state, const Vertices& last_end) {
  const double h = system_.step;
  state_ = &state;
  frame_.setZero();
  start_kinetic_ = 0.5 * h * h * inner(system_.threads, objective_.free_inertia(), state.v, state.v);
  start_.value = objective_.inertial_value(state.x);
  start_exact_ = false;
  if (!steady_) return;
  // The energy at the end of the last step is known if the step was completed, and is never negative. Filters change
  // unaffected positions by rounding only.
  const double known = std::exchange(end_energy_, 0);
  const auto bytes = static_cast<std::size_t>(state.x.size()) * sizeof(double);
  if (std::memcmp(state.x.data(), last_end.data(), bytes) == 0) {
    start_.value += known;
  } else if (springs_) {
    start_.value += objective_.least_elastic(known, largest_distance(system_.threads, state.x, last_end));
  }
}

bool EnergyBalance::gains(const Iterate& point, bool tolerant) {
  const auto too_much = [&] {
    const double surplus = gain(point) - rounding(point);
    return surplus > 0 && !(tolerant && surplus <= tolerated(point));
  };
  if (!too_much()) return false;
  if (start_exact_) return true;
  evaluate_start();
  return too_much();
}

bool EnergyBalance::gains_in_contact(const Iterate& point, double work, double tolerance, bool driven) {
  if (!start_exact_) evaluate_start();
  const Accuracy& accuracy = minimiser_.accuracy();
  const bool given = tolerance > 0 && !accuracy.is_default && accuracy.rule == StoppingRule::error;
  const Eigen::VectorXd& inertia = objective_.free_inertia();
  double solved = given ? tolerated(point) : 0.5 * tolerance * tolerance * inertia.sum();
  if (driven) solved = std::max(solved, tolerance * inertia.dot((point.x - state_->x).rowwise().norm()));
  return gain(point) - work > rounding(point) + noticed * start_kinetic_ + solved;
}

bool EnergyBalance::adds(const Iterate& from, const Iterate& to, double tolerated) {
  const auto too_much = [&] { return gain(to) > std::max(0.0, gain(from)) + tolerated + rounding(to); };
  if (!too_much()) return false;
  if (!start_exact_) evaluate_start();
  return too_much();
}

bool EnergyBalance::gains_much(const Iterate& point, double work) const {
  const double given = std::max(0.0, work), h = system_.step;
  const auto relative = state_->v.rowwise() - frame_ / h;
  const double kinetic = 0.5 * h * h * inner(system_.threads, objective_.free_inertia(), relative, relative);
  return gain(point) - given > much * (kinetic + given);
}

void EnergyBalance::evaluate_start() {
  start_.x = state_->x;
  start_.gradient.resize(start_.x.rows(), 3);
  system_.place_pins(system_.time(state_->step + 1), start_.x);
  start_.value = objective_.evaluate(start_.x, start_.gradient);
  start_exact_ = true;
}

double EnergyBalance::gain(const Iterate& point) const {
  // With g written out: g(x') − g(x) = ΔK + ΔE − W + K − h⁻¹Δx·M v.
  const double along = system_.step * inner(system_.threads, objective_.free_inertia(), point.x - state_->x, state_->v);
  const double at_rest = point.value - start_.value - start_kinetic_ + along;
  if (frame_.isZero(0)) return at_rest;
  // h v̄·Σ m(x' − y)/h² is v̄ times the change of momentum that the forces do not explain.
  return at_rest - frame_.dot(objective_.free_inertia().transpose() * (point.x - objective_.y()));
}

double EnergyBalance::rounding(const Iterate& point) const {
  // |h⁻¹Δx·M v| is at most the sum of K and the inertial terms at both ends.
  return objective_.rounding(point.value) + objective_.rounding(start_.value) + objective_.rounding(start_kinetic_);
}

double EnergyBalance::lost(const Iterate& point) const {
  const auto change = point.x - state_->x - system_.step * state_->v;  // h Δv
  return 0.5 * inner(system_.threads, objective_.free_inertia(), change, change);
}

double EnergyBalance::tolerated(const Iterate& point) const {
  const double h = system_.step;
  const Eigen::VectorXd& inertia = objective_.free_inertia();
  const auto way = point.x - state_->x;
  const StoppingRule rule = minimiser_.accuracy().rule;
  if (rule == StoppingRule::gradient) return minimiser_.tolerance() * way.norm();
  if (rule == StoppingRule::error) return minimiser_.tolerance() * inertia.dot(way.rowwise().norm());
  const auto push = objective_.y() - state_->x - h * state_->v;  // h² M⁻¹f
  const double work = inner(system_.threads, inertia, push, way);
  const double most =
      std::sqrt(inner(system_.threads, inertia, push, push) * inner(system_.threads, inertia, way, way));
  return std::min(tolerated_share * most, std::max(lost(point), -work));
}

double EnergyBalance::remove_gain(Iterate& point, bool touches, double allowed) {
  Vertices back = start_.x;
  if (is_free(system_) && !touches)
    back.rowwise() += mean(system_.cloth, objective_.y()) - mean(system_.cloth, start_.x);
  if (!frame_.isZero(0)) {
    for (Eigen::Index v = 0; v < back.rows(); ++v) {
      if (objective_.free_inertia()[v] > 0) back.row(v) += frame_;
    }
  }
  const Vertices way = point.x - back;
  Iterate trial{.x = point.x, .gradient = point.gradient};
  const auto gains_at = [&](double length) {
    system_.stop.check();
    trial.x = back + length * way;
    trial.value = objective_.evaluate(trial.x, trial.gradient);
    return !(gain(trial) <= allowed);
  };
  double length = 0.5;
  while (length > least_kept && gains_at(length)) length /= 2;
  if (length <= least_kept) length = 0;
  // Keep as much of the path as possible, as the cloth is slow enough already.
  const double halved = length;
  for (double more = halved / 2; more > halved / 16; more /= 2) {
    if (!gains_at(length + more)) length += more;
  }
  gains_at(length);
  std::swap(point, trial);
  return length;
}

void EnergyBalance::end(const Iterate& point) {
  if (!steady_) return;
  // Use the lower bound, so that a continued motion matches one that starts here.
  double energy = point.value - objective_.inertial_value(point.x);
  for (StepDissipation* one : system_.dissipations) energy -= one->value(point.x);
  end_energy_ = std::max(0.0, energy - objective_.rounding(point.value));
}

}  // namespace drape
