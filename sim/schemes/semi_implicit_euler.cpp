#include "sim/schemes/semi_implicit_euler.hpp"

#include "sim/schemes/explicit_step.hpp"

namespace drape {

SemiImplicitEuler::SemiImplicitEuler(const System& system)
    : system_(system),
      springs_(system.springs, system.cloth.vertex_count(), system.threads),
      pull_(explicit_pull(system)) {
  if (!system.fields.empty()) fields_.emplace(system);
}

StepReport SemiImplicitEuler::advance(State& state, StepForces& forces) {
  system_.begin(state);
  const double start = system_.time(state.step);
  const Vertices& force = with_energies(system_, state.x, start, forces.all(state, start), force_);
  // Do both updates in one pass if nothing changes the velocity in between.
  const bool at_once =
      !fields_ && system_.corrections.empty() && system_.filters.empty() && system_.pin_motions.empty();
  if (fields_) before_ = state.v;
  springs_.kick_and_drift(pull_, force, at_once ? system_.step : 0, state.v, state.x);
  StepReport report;
  if (at_once) return report;
  if (fields_) {
    report.converged = fields_->kick(state.x, start, before_, state.v);
    forces.note(fields_->force());
  }
  system_.correct(state);
  system_.move(state, nullptr);
  return report;
}

}  // namespace drape
