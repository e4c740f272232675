#include "sim/integrators/implicit_euler.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace drape {
namespace {

constexpr double sufficient_decrease = 1e-4;  // Armijo's constant, as usual (Nocedal and Wright 2006, section 3.1)
constexpr double smallest_length = 1e-10;
// Of what the forces can do in a step, see tolerated_gain. The homework's loosest tolerance gains up to 0.081 of it and
// stops after two iterations all the same.
constexpr double tolerated_share = 0.1;

/// Σ m a·b over the rows of n×3 expressions.
double inner(const Eigen::VectorXd& m, const auto& a, const auto& b) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) sum += (m.array() * a.col(axis).array() * b.col(axis).array()).sum();
  return sum;
}

}  // namespace

ImplicitEuler::ImplicitEuler(const System& system, const IntegratorSettings& settings, int default_max_iterations)
    : system_(system),
      stop_(settings.stop),
      tolerance_(settings.tolerance),
      max_iterations_(settings.max_iterations.value_or(default_max_iterations)),
      objective_(system),
      point_{.x = system.cloth.positions, .gradient = Vertices::Zero(system.cloth.vertex_count(), 3)},
      trial_(point_),
      start_(point_),
      free_(system.cloth.pins.empty() && system.energies.empty()) {}

StepReport ImplicitEuler::advance(State& state, const Vertices& force) {
  objective_.begin(state, force);
  begin_books(state);
  point_.x = objective_.y();
  point_.value = objective_.evaluate(point_.x, point_.gradient);
  start();
  StepReport report = minimise(state);
  if (gains_energy(state, report.converged)) {
    report.kept = shed_energy(state);
    report.converged = false;
  }
  energy_ = std::max(0.0, point_.value - objective_.inertial_value(point_.x));
  if (free_) balance_momentum();
  state.v = (point_.x - state.x) / system_.step;
  if (system_.filters.empty()) {
    state.x = point_.x;
  } else {
    system_.filter(state);
    state.x += system_.step * state.v;
    system_.place_pins(state, state.x);
  }
  system_.correct(state);
  system_.drive_pins(state);
  return report;
}

StepReport ImplicitEuler::minimise(const State& state) {
  StepReport report;
  // Who asks for a gradient gets it; a change says little about how far the minimum is.
  const auto balanced = [this] { return stop_ == StoppingRule::gradient && residual() < tolerance_; };
  for (; report.iterations < max_iterations_; ++report.iterations) {
    if (balanced()) return report;
    const double before = point_.value;
    const double change = iterate(point_);
    if (point_.value > before) {
      report.rise = std::max(report.rise, point_.value - before - objective_.rounding(before));
    }
    const bool settled = stop_ == StoppingRule::change && report.iterations >= 1 && change < tolerance_;
    if (settled && !gains_energy(state, true)) {
      ++report.iterations;
      return report;
    }
  }
  report.converged = balanced();
  return report;
}

double ImplicitEuler::descend(Point& point, const Vertices& direction, double slope) {
  const auto count = static_cast<std::size_t>(point.x.size());
  for (double length = 1; length >= smallest_length; length /= 2) {
    trial_.x = point.x;
    kernels().add_multiple(count, -length, direction.data(), trial_.x.data());
    trial_.value = objective_.evaluate(trial_.x, trial_.gradient);
    // Near the minimum g changes by less than it can be computed to; the direction is trusted there.
    const double highest = point.value - sufficient_decrease * length * slope + objective_.rounding(point.value);
    if (trial_.value <= highest) {
      std::swap(point, trial_);
      return length;
    }
  }
  return 0;
}

void ImplicitEuler::begin_books(const State& state) {
  const double h = system_.step;
  start_.x = state.x;
  system_.place_pins(state, start_.x);
  start_kinetic_ = 0.5 * h * h * inner(objective_.free_inertia(), state.v, state.v);
  // Where the last step ended, the energy is known, unless what pushes may have moved. None is below zero.
  const bool known = system_.energies.empty() && start_.x == point_.x;
  start_.value = objective_.inertial_value(start_.x) + (known ? energy_ : 0);
  start_exact_ = false;
}

bool ImplicitEuler::gains_energy(const State& state, bool tolerant) {
  const auto gains = [&] {
    const double surplus = gain(state, point_) - gain_rounding();
    return surplus > 0 && !(tolerant && surplus <= tolerated_gain(state));
  };
  if (!gains()) return false;
  if (!start_exact_) start_.value = objective_.evaluate(start_.x, start_.gradient);
  start_exact_ = true;
  return gains();
}

double ImplicitEuler::gain(const State& state, const Point& point) const {
  // With g written out: g(x') − g(x) = ΔK + ΔE − W + K − h⁻¹Δx·M v.
  const double along = system_.step * inner(objective_.free_inertia(), point.x - start_.x, state.v);
  return point.value - start_.value - start_kinetic_ + along;
}

double ImplicitEuler::gain_rounding() const {
  // h⁻¹Δx·M v is at most K and what the inertia holds at either end together.
  return objective_.rounding(point_.value) + objective_.rounding(start_.value) + objective_.rounding(start_kinetic_);
}

double ImplicitEuler::tolerated_gain(const State& state) const {
  const double h = system_.step;
  const Eigen::VectorXd& inertia = objective_.free_inertia();
  const auto way = point_.x - start_.x;
  if (stop_ == StoppingRule::gradient) return tolerance_ * way.norm();
  const auto change = way - h * state.v;                      // h Δv
  const auto push = objective_.y() - start_.x - h * state.v;  // h² M⁻¹f
  const double work = inner(inertia, push, way), lost = 0.5 * inner(inertia, change, change);
  const double most = std::sqrt(inner(inertia, push, push) * inner(inertia, way, way));
  return std::min(tolerated_share * most, std::max(lost, -work));
}

double ImplicitEuler::shed_energy(const State& state) {
  // A cloth that nothing holds keeps its motion as a whole.
  Vertices back = start_.x;
  if (free_) back.rowwise() += mean(objective_.y()) - mean(start_.x);
  const Vertices way = point_.x - back;
  const auto gains_at = [&](double length) {
    trial_.x = back + length * way;
    trial_.value = objective_.evaluate(trial_.x, trial_.gradient);
    return !(gain(state, trial_) <= 0);
  };
  double length = 0.5;
  while (length > smallest_length && gains_at(length)) length /= 2;
  if (length <= smallest_length) length = 0;
  // As much of the way as may be: the cloth is slow enough already.
  const double halved = length;
  for (double more = halved / 2; more > halved / 16; more /= 2) {
    if (!gains_at(length + more)) length += more;
  }
  gains_at(length);
  std::swap(point_, trial_);
  return length;
}

Eigen::RowVector3d ImplicitEuler::mean(const Vertices& v) const {
  const Eigen::VectorXd& m = system_.cloth.masses;
  return (m.transpose() * v) / m.sum();
}

void ImplicitEuler::balance_momentum() {
  const Eigen::RowVector3d shift = mean(objective_.y()) - mean(point_.x);
  point_.x.rowwise() += shift;
  point_.gradient += objective_.inertia() * shift;
}

double ImplicitEuler::residual() { return norm(point_.gradient); }

}  // namespace drape
