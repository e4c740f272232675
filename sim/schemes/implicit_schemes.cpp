#include "sim/schemes/implicit_schemes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/parallel/vectors.hpp"

namespace drape {

BackwardEuler::BackwardEuler(const System& system, const MakeSolver& make_solver, bool instantaneous)
    : MinimisingScheme(system, system.step, make_solver, Directions::at_start),
      instantaneous_(instantaneous),
      balance_(system, objective_, *solver_) {
  if (!system.contacts.empty() || !system.limits.empty()) contact_.emplace(system);
  if (system.limits.empty()) return;
  limited_ = point_;
  limited_v_ = Vertices::Zero(system.cloth.vertex_count(), 3);
  nothing_held_ = {.acceleration = limited_v_, .tensions = Eigen::VectorXd::Zero(std::ssize(system.cloth.springs))};
}

StepReport BackwardEuler::solve_step(const Vertices& steady, const std::function<bool()>& may_end) {
  if (!contact_ || !contact_->touches(point_.x)) {
    const StepReport report = solver_->minimise(point_, may_end);
    if (free_) balance_momentum(system_.cloth, objective_, point_);
    // The balance too may have brought the cloth into contact.
    if (!contact_ || !contact_->touches(point_.x)) return report;
  }
  if (!problem_) problem_.emplace(system_, objective_, solver_->constant_factor(), solver_->hessian());
  contact_->choose_start(*problem_, steady, point_);
  const StepReport report = contact_->solve(*problem_, solver_->accuracy(), solver_->max_iterations(), point_);
  if (free_ && !contact_->touches_obstacles()) balance_in_contact();
  return report;
}

void BackwardEuler::balance_in_contact() {
  const Iterate end = point_;
  balance_momentum(system_.cloth, objective_, point_);
  if (!contact_->collides(point_.x)) return;
  // A shortened step lacks the momentum of the collision that it avoids.
  point_ = end;
  static_cast<void>(contact_->touches(point_.x));
}

double BackwardEuler::shorten(bool held) {
  if (!contact_ || held) return balance_.remove_gain(point_, held);
  const Iterate end = point_;
  const double part = balance_.remove_gain(point_);
  // Free fall may lead beyond an obstacle. The path back to the start of the step is clear.
  if (!contact_->collides(point_.x)) return part;
  point_ = end;
  return balance_.remove_gain(point_, true);
}

double BackwardEuler::shorten_beside_moving(double work, const Eigen::RowVector3d& way,
                                            const Eigen::RowVector3d& force) {
  const Iterate end = point_;
  for (const Eigen::RowVector3d& frame : {way, Eigen::RowVector3d(0, 0, 0)}) {
    balance_.follow(frame);
    const double part = balance_.remove_gain(point_, true, std::max(0.0, work - frame.dot(force)));
    // The obstacle may have moved beyond what stays behind.
    if (!contact_->collides(point_.x)) return part;
    point_ = end;
  }
  static_cast<void>(contact_->touches(point_.x));
  return 1;
}

double BackwardEuler::residual() {
  return touched_ ? norm(system_.threads, contact_->residual()) : MinimisingScheme::residual();
}

double BackwardEuler::error() { return touched_ ? contact_->error() : MinimisingScheme::error(); }

double BackwardEuler::residual_force() {
  return touched_ ? contact_->residual().rowwise().norm().sum() : MinimisingScheme::residual_force();
}

bool BackwardEuler::is_blocked_by_contact(const State& from, const Vertices& x) {
  contact_->begin(from, system_.time(from.step), system_.time(from.step + 1), instantaneous_);
  return contact_->is_blocked(x);
}

void BackwardEuler::remove_gain(StepReport& report) {
  if (touched_) {
    const double met = report.converged ? contact_->tolerance() : 0;
    const double work = contact_->work(point_.x, report.converged);
    if (!contact_->driven(point_.x)) {
      if (!balance_.gains_in_contact(point_, work, met, false)) return;
      report.kept = shorten(contact_->touches_obstacles());
    } else {
      const Eigen::RowVector3d way = contact_->mean_drive(point_.x), force = contact_->force_on_cloth(point_.x);
      const double relative = work - way.dot(force);
      balance_.follow(way);
      if (!balance_.gains_in_contact(point_, relative, met, true)) return;
      if (balance_.gains_much(point_, relative)) report.kept = shorten_beside_moving(work, way, force);
    }
  } else {
    // The minimiser has checked a step that ended by small changes, unless it was just moved.
    const bool checked = !free_ && report.converged && solver_->accuracy().rule == StoppingRule::change;
    if (checked || !balance_.gains(point_, report.converged)) return;
    report.kept = shorten(false);
  }
  report.converged = false;
}

bool BackwardEuler::limit_strain(State& state, StepReport& report) {
  divided_difference(system_.threads, point_.x, state.x, system_.step, limited_v_);
  const bool converged = system_.filter(state, limited_v_);
  sum(system_.threads, state.x, system_.step, limited_v_, limited_.x);
  system_.place_pins(system_.time(state.step + 1), limited_.x);
  limited_.value = objective_.evaluate(limited_.x, limited_.gradient);
  if (balance_.adds(point_, limited_, system_.tolerated_gain()) || contact_->touches(limited_.x)) return false;
  // The gradient is still that of the minimum, which tells how well it was solved.
  std::swap(point_.x, limited_.x);
  point_.value = limited_.value;
  report.converged = report.converged && converged;
  return true;
}

StepReport BackwardEuler::advance(State& state, StepForces& forces) {
  const Expected expected = take_expected();
  system_.begin(state);
  const Vertices& force = forces.all(state, system_.time(state.step));
  if (contact_) {
    contact_->begin(state, system_.time(state.step), system_.time(state.step + 1), instantaneous_);
    contact_->expect(state.contact_forces);
    steady_ = state.x + system_.step * state.v;
    system_.place_pins(system_.time(state.step + 1), steady_);
  }
  const auto begun = [&] { balance_.begin(state, point_.x); };
  const auto minimise = [&] { return solve_step(steady_, [this] { return !balance_.gains(point_, true); }); };
  const auto solve = [&] {
    const StepReport report =
        solve_with_fields(state, force, system_.time(state.step + 1), expected.late, begun, minimise);
    touched_ = contact_ && !contact_->contacts().empty();
    return report;
  };
  StepReport report = solve();
  if (!touched_) remove_gain(report);
  if (!touched_ && !system_.filters.empty() && !limit_strain(state, report)) {
    contact_->include_limits();
    const int before = report.iterations;
    report = solve();
    report.iterations += before;
    if (!touched_) remove_gain(report);
  }
  if (touched_) {
    remove_gain(report);
    if (!system_.limits.empty()) state.restraint = nothing_held_;
  }
  if (is_lost()) report.converged = false;
  if (fields_) forces.record_velocity_force(fields_->end());
  balance_.end(point_);
  divided_difference(system_.threads, point_.x, state.x, system_.step, state.v);
  copy(system_.threads, point_.x, state.x);
  state.contact_forces.clear();
  // An unconverged solve does not determine a bounce well enough to give it energy. A bounce changes the velocity after
  // the step, and no filter moves the cloth by it.
  if (touched_ && report.converged) contact_->rebound(instantaneous_, state.v);
  if (touched_) state.contact_forces = contact_->forces();
  system_.correct(state);
  return report;
}

namespace {
namespace tableau {

constexpr double gamma = Sdirk2::gamma;
constexpr double rest = (1 - gamma) / gamma;  // remaining time after stage 1, in stages
constexpr double delta = 1 - 1 / (2 * gamma);

}  // namespace tableau
}  // namespace

Sdirk2::Sdirk2(const System& system, const MakeSolver& make_solver)
    : MinimisingScheme(system, tableau::gamma * system.step, make_solver, Directions::predicted),
      make_solver_(make_solver) {
  if (!system.contacts.empty() || !system.limits.empty()) euler_.emplace(system, make_solver, true);
}

double Sdirk2::residual() { return by_euler_ ? euler_->residual() : MinimisingScheme::residual(); }
double Sdirk2::error() { return by_euler_ ? euler_->error() : MinimisingScheme::error(); }
double Sdirk2::residual_force() { return by_euler_ ? euler_->residual_force() : MinimisingScheme::residual_force(); }

StepReport Sdirk2::redo(State& state, StepForces& forces) {
  if (!euler_) euler_.emplace(system_, make_solver_, true);
  by_euler_ = true;
  if (of_step_.late != nullptr) euler_->expect(*of_step_.early, *of_step_.late);
  return euler_->advance(state, forces);
}

std::optional<double> Sdirk2::energy_bound(const State& state) const {
  if (by_euler_ || !system_.filters.empty()) return std::nullopt;
  const double kinetic = 0.5 * system_.cloth.masses.dot(state.v.rowwise().squaredNorm());
  // Dissipation potentials of the stage are not negative.
  return kinetic + point_.value - objective_.inertial_value(point_.x);
}

StepReport Sdirk2::advance(State& state, StepForces& forces) {
  by_euler_ = false;
  of_step_ = take_expected();
  if (!euler_) return advance_freely(state, forces);
  const bool touches = !system_.contacts.empty();
  if (touches && euler_->is_blocked_by_contact(state, state.x + system_.step * state.v)) return redo(state, forces);
  before_ = state;
  state.contact_forces.clear();
  StepReport freely = advance_freely(state, forces);
  if (!gained_ && !(touches && euler_->is_blocked_by_contact(before_, state.x))) {
    freely.converged = freely.converged && !euler_->is_lost();
    return freely;
  }
  state = before_;
  StepReport report = redo(state, forces);
  report.iterations += freely.iterations;
  return report;
}

StepReport Sdirk2::advance_freely(State& state, StepForces& forces) {
  const double start = system_.time(state.step), end = system_.time(state.step + 1);
  const double first = start + tableau::gamma * system_.step;
  StepReport report;
  system_.begin(state);
  system_.correct_half(state);
  find_forces(state, forces);
  stage_ = state;
  solve(first, of_step_.early, report);
  if (fields_) of_fields_ = (1 - tableau::gamma) * fields_->end();
  if (forces.any_depends_on_velocity()) find_second_forces(first, forces);
  stage_.x = state.x + tableau::rest * (stage_.x - state.x);
  stage_.v = state.v + tableau::rest * (stage_.v - state.v);
  solve(end, of_step_.late, report);
  if (fields_) {
    of_fields_ += tableau::gamma * fields_->end();
    forces.record_velocity_force(of_fields_);
  }
  state.v = stage_.v;
  if (system_.filters.empty()) {
    copy(system_.threads, stage_.x, state.x);
  } else {
    report.converged = system_.move(state, stage_.x, way_) && report.converged;
    gained_ = filters_gain(state);
  }
  system_.correct_half(state);
  system_.drive_pins(end, state.v);
  return report;
}

namespace {

/// Finds the mean velocity of its piece's pins for each vertex, 0 without pins, n×3 [m/s].
void find_pin_velocities(const Cloth& cloth, const Vertices& v, Vertices& mean) {
  mean.setZero(v.rows(), 3);
  const auto fill = [&](Eigen::Index first, Eigen::Index count) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    int pins = 0;
    for (const int pin : cloth.pins) {
      if (pin < first || pin >= first + count) continue;
      sum += v.row(pin);
      ++pins;
    }
    if (pins > 0) mean.middleRows(first, count).rowwise() = (sum / pins).eval();
  };
  if (cloth.pieces.empty()) fill(0, v.rows());
  for (const ClothPiece& piece : cloth.pieces) fill(piece.first_vertex, piece.vertex_count);
}

}  // namespace

bool Sdirk2::filters_gain(const State& state) {
  // Relative to its pins, so that the pull of a limit at moving pins is no gain.
  const double h = objective_.duration();
  find_pin_velocities(system_.cloth, state.v, pin_velocities_);
  const auto kinetic = [&](const Vertices& v) {
    return 0.5 * h * h * objective_.free_inertia().dot((v - pin_velocities_).rowwise().squaredNorm());
  };
  limited_.x = state.x;
  limited_.value = objective_.evaluate(limited_.x, limited_.gradient);
  const double elastic = limited_.value - objective_.inertial_value(state.x);
  const double before = point_.value - objective_.inertial_value(point_.x);
  const double work = force_.cwiseProduct(state.x - stage_.x).sum();
  const double rounding = objective_.rounding(limited_.value) + objective_.rounding(point_.value);
  return kinetic(state.v) + elastic - work > kinetic(stage_.v) + before + rounding + system_.tolerated_gain();
}

void Sdirk2::find_forces(const State& state, StepForces& forces) {
  const double start = system_.time(state.step), half = system_.step / 2;
  stage_ = state;
  add_multiple(system_.threads, half, state.v, stage_.x);
  system_.place_pins(start + half, stage_.x);
  force_ = forces.sum_position_forces(stage_, start + half);
  if (!forces.any_depends_on_velocity()) return;
  forces.sum_velocity_forces(state, start, of_start_);
  force_ += of_start_;
}

void Sdirk2::find_second_forces(double time, StepForces& forces) {
  system_.drive_pins(time, stage_.v);
  forces.sum_velocity_forces(stage_, time, of_stage_);
  force_ -= of_start_;
  // v₂ contains (1 − γ)h of the first stage's forces; γh of these are added here.
  of_stage_ = tableau::delta * of_start_ + (1 - tableau::delta) * of_stage_;
  forces.record_velocity_force(of_stage_);
  force_ += (of_stage_ - (1 - tableau::gamma) * of_start_) / tableau::gamma;
}

void Sdirk2::solve(double end, const Vertices* expected, StepReport& report) {
  const auto minimise = [this] { return solver_->minimise(point_, [] { return true; }); };
  const StepReport stage = solve_with_fields(
      stage_, force_, end, expected, [] {}, minimise);
  if (free_) balance_momentum(system_.cloth, objective_, point_);
  divided_difference(system_.threads, point_.x, stage_.x, objective_.duration(), stage_.v);
  copy(system_.threads, point_.x, stage_.x);
  report.iterations += stage.iterations;
  report.converged = report.converged && stage.converged;
  report.rise = std::max(report.rise, stage.rise);
}

Sdirk2Guard::Sdirk2Guard(const System& system)
    : condition_(system),
      watches_((system.pin_motions.empty() && system.filters.empty() && system.contacts.empty()) ||
               system.only_loses_energy()),
      rounding_(energy_rounding(system)) {}

void Sdirk2Guard::begin(const State& state, double energy) {
  if (!watches_) return;
  memory_ = {.explained = std::max(energy, rounding_), .checked_at = state.x, .work = energy, .energy = energy};
}

void Sdirk2Guard::restore(const EnergyMemory& memory) {
  if (watches_) memory_ = memory;
}

std::optional<double> Sdirk2Guard::check_step(const State& state, const Vertices& push, bool /*constant*/,
                                              const EnergyNow& energy) {
  if (!watches_) return std::nullopt;
  EnergyMemory& memory = *memory_;
  const double work = push.cwiseProduct(state.x - memory.checked_at).sum();
  const double before = memory.energy.value_or(memory.work);
  memory.work += work;
  memory.explained = std::max(memory.explained, memory.work);
  const double slack = most_gain * memory.explained;
  const double most = before + work + std::clamp(memory.work + slack - before - work, 0.0, slack);
  const double now = energy(most);
  memory.energy = now;
  memory.checked_at = state.x;
  if (now <= most) return std::nullopt;
  return now / memory.explained;
}

std::string Sdirk2Guard::remedy() const {
  return "; sdirk2 can gain energy where steps are solved loosely or the cloth is crumpled: use a smaller tolerance "
         "and more max_iterations, a shorter [time] step, or scheme = \"backward-euler\", which cannot";
}

}  // namespace drape
