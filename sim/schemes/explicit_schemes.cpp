#include "sim/schemes/explicit_schemes.hpp"

#include <algorithm>
#include <utility>

#include "sim/parallel/vectors.hpp"

namespace drape {

Eigen::VectorXd explicit_pull(const System& system) {
  Eigen::VectorXd pull = -system.step * system.cloth.masses.cwiseInverse();
  for (const int pin : system.cloth.pins) pull[pin] = 0;
  return pull;
}

const Vertices& with_energies(const System& system, const Vertices& x, double time, const Vertices& force,
                              Vertices& scratch) {
  if (system.energies.empty()) return force;
  scratch.setZero(force.rows(), 3);
  for (const auto& energy : system.energies) energy->add_gradient(x, time, scratch);
  scratch = force - scratch;
  return scratch;
}

namespace {

/// Returns true if steps have nothing but springs, constant forces and corrections.
bool acts_alike(const System& system) {
  return system.energies.empty() && system.fields.empty() && system.dashpots.empty() && system.filters.empty() &&
         system.pin_motions.empty() &&
         std::ranges::all_of(system.forces, [](const auto& force) { return force->constant(); });
}

/// Returns the number of steps to take at once when some are left, so that all passes have about as many.
int even_share(std::int64_t left, int most) {
  const std::int64_t passes = (left + most - 1) / most;
  return static_cast<int>((left + passes - 1) / passes);
}

}  // namespace

SemiImplicitEuler::SemiImplicitEuler(const System& system)
    : system_(system),
      springs_(system.network()),
      pull_(explicit_pull(system)),
      decay_(system.decay(system.step)),
      alike_(decay_ && acts_alike(system)) {
  if (!system.dashpots.empty())
    damping_.emplace(system, system.whole_step / static_cast<double>(DampingKick::kicks_in(system.substeps)));
  if (!system.fields.empty()) fields_.emplace(system);
}

StepReport SemiImplicitEuler::advance(State& state, StepForces& forces) {
  system_.begin(state);
  const double start = system_.time(state.step);
  const Vertices& force = with_energies(system_, state.x, start, forces.all(state, start), force_);
  // Do both updates in one pass if nothing changes the velocity in between.
  const bool damped = damping_ && DampingKick::acts_in(state.step, system_.substeps);
  const bool at_once = !damped && !fields_ && decay_ && system_.filters.empty() && system_.pin_motions.empty();
  if (fields_ || damped) before_ = state.v;
  const Drift drift = at_once ? Drift{.h = system_.step, .before = *decay_} : Drift{.h = 0};
  const double squares = springs_.kick_and_drift(pull_, force, drift, state.v, state.x);
  size_ = at_once ? std::optional(squares) : std::nullopt;
  StepReport report;
  if (at_once) return report;
  if (damped) {
    damping_->set_directions(state.x);
    damping_->apply_within(before_, state.v);
  }
  if (fields_) {
    report.converged = fields_->kick(state.x, start, before_, state.v);
    forces.record_velocity_force(fields_->force());
  }
  system_.correct(state);
  report.converged = system_.move(state) && report.converged;
  return report;
}

std::int64_t SemiImplicitEuler::advance_at_once(State& state, StepForces& forces, std::int64_t left) {
  if (!alike_ || springs_.most_steps() == 1 || left == 1) return 0;
  const int count = even_share(left, springs_.most_steps());
  size_ = springs_.kick_and_drift_times(count, pull_, forces.all(state, system_.time(state.step)),
                                        {.h = system_.step, .before = *decay_}, {.h = 0}, state.v, state.x);
  return count;
}

namespace {

bool depends_on_velocities(const System& system) {
  return !system.fields.empty() ||
         std::ranges::any_of(system.forces, [](const auto& force) { return force->depends_on_velocity(); });
}

}  // namespace

Verlet::Verlet(const System& system)
    : system_(system),
      springs_(system.network()),
      pull_(explicit_pull(system)),
      half_decay_(system.decay(system.step / 2)),
      alike_(half_decay_ && acts_alike(system)) {
  if (!system.dashpots.empty() && depends_on_velocities(system)) {
    half_damping_.emplace(system, system.step / 2);
  } else if (!system.dashpots.empty()) {
    damping_.emplace(system, system.whole_step / static_cast<double>(DampingKick::kicks_in(system.substeps)));
  }
  if (!system.fields.empty()) fields_.emplace(system);
}

StepReport Verlet::advance(State& state, StepForces& forces) {
  const double half = system_.step / 2;
  const double middle = system_.time(state.step) + half, end = system_.time(state.step + 1);
  const auto drift = [&] { add_multiple(system_.threads, half, state.v, state.x); };
  const bool by_velocity = fields_ || forces.any_depends_on_velocity();
  StepReport report;
  const bool damped = half_damping_ || (damping_ && DampingKick::acts_in(state.step, system_.substeps));
  const bool at_once = !by_velocity && !damped && half_decay_ && system_.filters.empty() && system_.pin_motions.empty();
  size_.reset();
  if (at_once) {
    drape::drift(system_.threads, {.h = half, .before = *half_decay_}, state.v, state.x);
    report.converged = kick(state, middle, forces, {.h = half, .after = *half_decay_});
    return report;
  }
  system_.begin(state);
  system_.correct_half(state);
  if (!system_.filters.empty()) start_x_ = state.x;
  drift();
  system_.place_pins(middle, state.x);
  if (by_velocity) system_.drive_pins(middle, state.v);
  report.converged = damped ? kick_with_dashpots(state, middle, forces) : kick(state, middle, forces, {.h = 0});
  drift();
  system_.place_pins(end, state.x);
  if (!system_.filters.empty()) {
    std::swap(state.x, start_x_);
    report.converged = system_.move(state, start_x_, way_) && report.converged;
  }
  system_.correct_half(state);
  system_.drive_pins(end, state.v);
  return report;
}

std::int64_t Verlet::advance_at_once(State& state, StepForces& forces, std::int64_t left) {
  if (!alike_ || springs_.most_steps() == 1 || left == 1) return 0;
  const int count = even_share(left, springs_.most_steps());
  const Drift before{.h = system_.step / 2, .before = *half_decay_}, after{.h = before.h, .after = *half_decay_};
  const Vertices& force = forces.sum_position_forces(state, system_.time(state.step));
  drift(system_.threads, before, state.v, state.x);
  size_ = springs_.kick_and_drift_times(count, pull_, force, after, before, state.v, state.x);
  return count;
}

bool Verlet::kick(State& state, double time, StepForces& forces, const Drift& drift) {
  const bool by_velocity = fields_ || forces.any_depends_on_velocity();
  if (by_velocity) start_v_ = state.v;
  const Vertices& push = forces.sum_position_forces(state, time);
  const Vertices& force = with_energies(system_, state.x, time, push, force_);
  const double squares = springs_.kick_and_drift(pull_, force, drift, state.v, state.x);
  if (drift.h != 0) size_ = squares;
  return !by_velocity || apply_velocity_forces(state, time, forces);
}

bool Verlet::kick_with_dashpots(State& state, double time, StepForces& forces) {
  system_.drive_pins(time, state.v);
  DampingKick& damping = half_damping_ ? *half_damping_ : *damping_;
  damping.set_directions(state.x);
  if (half_damping_) damping.apply(state.v);
  start_v_ = state.v;
  const bool found = kick(state, time, forces, {.h = 0});
  if (half_damping_) {
    damping.apply(state.v);
  } else {
    damping.apply_within(start_v_, state.v);
  }
  return found;
}

bool Verlet::apply_velocity_forces(State& state, double time, StepForces& forces) {
  const bool others = forces.any_depends_on_velocity();
  if (!fields_) {
    add_velocity_forces(state, time, forces);
    return true;
  }
  before_ = start_v_;
  bool found = fields_->kick(state.x, time, before_, state.v);
  if (others) {
    // Fields and other forces depend on each other. For second order each needs only an estimate of the other.
    add_velocity_forces(state, time, forces);
    state.v += pull_.asDiagonal() * fields_->force();
    found = fields_->kick(state.x, time, before_, state.v);
  }
  forces.record_velocity_force(fields_->force());
  return found;
}

void Verlet::add_velocity_forces(State& state, double time, StepForces& forces) {
  std::swap(state.v, start_v_);
  forces.sum_velocity_forces(state, time, force_);
  state.v = start_v_ - pull_.asDiagonal() * force_;
  forces.sum_velocity_forces(state, time, more_force_);
  force_ = (force_ + more_force_) / 2;
  state.v = start_v_ - pull_.asDiagonal() * force_;
  forces.record_velocity_force(force_);
}

}  // namespace drape
