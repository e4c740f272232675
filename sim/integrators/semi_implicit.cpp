#include "sim/integrators/semi_implicit.hpp"

namespace drape {

SemiImplicitEuler::SemiImplicitEuler(const System& system)
    : system_(system),
      springs_(system.springs, system.cloth.vertex_count()),
      pull_(-system.step * system.cloth.masses.cwiseInverse()) {
  for (const int pin : system.cloth.pins) pull_[pin] = 0;
}

StepReport SemiImplicitEuler::advance(State& state, const Vertices& force) {
  // Where nothing changes the velocity in between, both updates are one pass.
  const bool at_once = system_.corrections.empty() && system_.filters.empty();
  springs_.kick_and_drift(pull_, force, at_once ? system_.step : 0, state.v, state.x);
  if (!at_once) {
    system_.correct(state);
    system_.filter(state);
    kernels().add_multiple(static_cast<std::size_t>(state.x.size()), system_.step, state.v.data(), state.x.data());
  }
  return {};
}

}  // namespace drape
