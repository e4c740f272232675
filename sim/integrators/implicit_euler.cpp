#include "sim/integrators/implicit_euler.hpp"

#include <algorithm>
#include <utility>

namespace drape {
namespace {

constexpr double sufficient_decrease = 1e-4;  // Armijo's constant, as usual (Nocedal and Wright 2006, section 3.1)
constexpr double smallest_length = 1e-10;
// Of the energy, by which a step may grow that stops where an iteration changes little. The homework's loosest tolerance
// gains up to 0.02 in a step and stops after two iterations all the same.
constexpr double tolerated_gain = 0.03;

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
  system_.begin(state);
  objective_.begin(state, force);
  point_.x = objective_.y();
  point_.value = objective_.evaluate(point_.x, point_.gradient);
  start();
  start_known_ = false;
  StepReport report = minimise(state);
  if (!report.converged && gains_energy(state, 0)) report.kept = shed_energy(state);
  if (free_) balance_momentum();
  state.v = (point_.x - state.x) / system_.step;
  if (system_.filters.empty()) {
    state.x = point_.x;
  } else {
    system_.filter(state);
    state.x += system_.step * state.v;
    system_.place_pins(state, state.x);
    system_.finish(state);
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
    if (settled && !gains_energy(state, tolerated_gain)) {
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

bool ImplicitEuler::gains_energy(const State& state, double share) {
  // The energy can only have grown where ∇g·Δx > ½‖v' − v‖²_M, which is found without another evaluation of g.
  const double h = system_.step;
  const Eigen::VectorXd& inertia = objective_.free_inertia();
  double given = 0, lost = 0, kinetic = 0, moved = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto way = (point_.x.col(axis) - state.x.col(axis)).array();
    given += (point_.gradient.col(axis).array() * way).sum();
    lost += 0.5 * (inertia.array() * (way - h * state.v.col(axis).array()).square()).sum();
    kinetic += 0.5 * (inertia.array() * way.square()).sum();
    moved += 0.5 * (inertia.array() * (point_.x.col(axis) - objective_.y().col(axis)).array().square()).sum();
  }
  if (!(given > lost)) return false;
  const double energy = kinetic + std::max(0.0, point_.value - moved);
  return gain(state, point_) > share * energy + objective_.rounding(point_.value);
}

double ImplicitEuler::gain(const State& state, const Point& point) {
  if (!start_known_) {
    start_.x = state.x;
    system_.place_pins(state, start_.x);
    start_.value = objective_.evaluate(start_.x, start_.gradient);
    start_known_ = true;
  }
  // With g written out: g(x') − g(x) = ΔK + ΔE − W + K − h⁻¹Δx·M v.
  const double h = system_.step;
  double kinetic = 0, along = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto way = (point.x.col(axis) - start_.x.col(axis)).array();
    const auto v = h * state.v.col(axis).array();
    kinetic += 0.5 * (objective_.free_inertia().array() * v.square()).sum();
    along += (objective_.free_inertia().array() * way * v).sum();
  }
  return point.value - start_.value - kinetic + along;
}

double ImplicitEuler::shed_energy(const State& state) {
  // A cloth that nothing holds keeps its motion as a whole.
  Vertices back = start_.x;
  if (free_) back.rowwise() += mean(objective_.y()) - mean(start_.x);
  const Vertices way = point_.x - back;
  double length = 1;
  do {
    length = length > smallest_length ? length / 2 : 0;
    trial_.x = back + length * way;
    trial_.value = objective_.evaluate(trial_.x, trial_.gradient);
  } while (length > 0 && !(gain(state, trial_) <= 0));
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
