#include "sim/schemes/backward_euler.hpp"

#include "sim/parallel/vectors.hpp"

namespace drape {

BackwardEuler::BackwardEuler(const System& system, const MakeSolver& make_solver, bool instantaneous)
    : MinimisingScheme(system, system.step, make_solver, Directions::at_start),
      of_the_moment_(instantaneous),
      books_(system, objective_, *solver_) {
  if (!system.contacts.empty()) contact_.emplace(system);
}

StepReport BackwardEuler::solve_step(const Vertices& steady, const std::function<bool()>& may_end) {
  if (!contact_) return solver_->minimise(point_, may_end);
  if (!contact_->touches(point_.x)) {
    const StepReport report = solver_->minimise(point_, may_end);
    if (!contact_->touches(point_.x)) return report;
  }
  if (!problem_) problem_.emplace(system_, objective_, solver_->constant_factor(), solver_->hessian());
  contact_->choose_start(*problem_, steady, point_);
  return contact_->solve(*problem_, solver_->accuracy(), solver_->max_iterations(), point_);
}

double BackwardEuler::shed(bool held) {
  if (!contact_ || held) return books_.shed(point_, held);
  const Iterate end = point_;
  const double part = books_.shed(point_);
  // Free fall may lead beyond an obstacle. The path back to the start of the step is clear.
  if (!contact_->collides(point_.x)) return part;
  point_ = end;
  return books_.shed(point_, true);
}

double BackwardEuler::residual() {
  return touched_ ? norm(system_.threads, contact_->residual()) : MinimisingScheme::residual();
}

double BackwardEuler::error() { return touched_ ? contact_->error() : MinimisingScheme::error(); }

double BackwardEuler::residual_force() {
  return touched_ ? contact_->residual().rowwise().norm().sum() : MinimisingScheme::residual_force();
}

bool BackwardEuler::is_blocked_by_contact(const State& from, const Vertices& x) {
  contact_->begin(from, system_.time(from.step), system_.time(from.step + 1), of_the_moment_);
  return contact_->is_blocked(x);
}

StepReport BackwardEuler::advance(State& state, StepForces& forces) {
  const Expected expected = take_expected();
  system_.begin(state);
  const Vertices& force = forces.all(state, system_.time(state.step));
  Vertices steady;
  if (contact_) {
    contact_->begin(state, system_.time(state.step), system_.time(state.step + 1), of_the_moment_);
    contact_->expect(state.contact_forces);
    steady = state.x + system_.step * state.v;
    system_.place_pins(system_.time(state.step + 1), steady);
  }
  const auto begun = [&] { books_.begin(state, point_.x); };
  const auto minimise = [&] { return solve_step(steady, [this] { return !books_.gains(point_, true); }); };
  StepReport report = solve_with_fields(state, force, system_.time(state.step + 1), expected.late, begun, minimise);
  if (fields_) forces.note(fields_->end());
  const bool touches = touched_ = contact_ && !contact_->contacts().empty();
  const bool held = touches && contact_->touches_obstacles();
  if (free_ && !held) {
    const Iterate end = point_;
    balance_momentum(system_.cloth, objective_, point_);
    // A shortened step lacks the momentum of the collision that it avoids.
    if (contact_ && !report.converged && contact_->collides(point_.x)) point_ = end;
  }
  // The minimiser has checked a step that ended by small changes, unless it was just moved.
  const bool looked = !free_ && report.converged && solver_->accuracy().rule == StoppingRule::change;
  if (touches && books_.gains_in_contact(point_, contact_->work(point_.x, report.converged))) {
    if (!contact_->carried()) report.kept = shed(held);
    report.converged = false;
  }
  if (!touches && !looked && books_.gains(point_, report.converged)) {
    report.kept = shed(false);
    report.converged = false;
  }
  books_.end(point_);
  divided_difference(system_.threads, point_.x, state.x, system_.step, state.v);
  // An unconverged solve does not determine a bounce well enough to give it energy.
  if (touches && report.converged) contact_->rebound(of_the_moment_, state.v);
  if (touches && report.converged) {
    state.contact_forces = contact_->forces();
  } else {
    state.contact_forces.clear();
  }
  system_.move(state, &point_.x);
  system_.correct(state);
  return report;
}

}  // namespace drape
