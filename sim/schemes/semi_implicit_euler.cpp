#include "sim/schemes/semi_implicit_euler.hpp"

#include "sim/schemes/explicit_step.hpp"

namespace drape {

SemiImplicitEuler::SemiImplicitEuler(const System& system)
    : system_(system),
      springs_(system.springs, system.cloth.vertex_count(), system.threads),
      pull_(explicit_pull(system, "semi-implicit Euler")) {}

StepReport SemiImplicitEuler::advance(State& state, StepForces& forces) {
  system_.begin(state);
  const double start = system_.time(state.step);
  const Vertices& force = with_energies(system_, state.x, start, forces.all(state, start), force_);
  // Where nothing changes the velocity in between, both updates are one pass.
  const bool at_once = system_.corrections.empty() && system_.filters.empty() && system_.pin_motions.empty();
  springs_.kick_and_drift(pull_, force, at_once ? system_.step : 0, state.v, state.x);
  if (!at_once) {
    system_.correct(state);
    system_.move(state, nullptr);
  }
  return {};
}

}  // namespace drape
