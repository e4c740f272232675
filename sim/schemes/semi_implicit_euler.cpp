#include "sim/schemes/semi_implicit_euler.hpp"

#include "core/error.hpp"

namespace drape {

SemiImplicitEuler::SemiImplicitEuler(const System& system)
    : system_(system),
      springs_(system.springs, system.cloth.vertex_count()),
      pull_(-system.step * system.cloth.masses.cwiseInverse()) {
  if (!system.all_internal()) {
    throw UsageError(
        "semi-implicit Euler solves for nothing: it cannot have an energy that is, such as a contact with response = "
        "\"implicit\"");
  }
  for (const int pin : system.cloth.pins) pull_[pin] = 0;
}

StepReport SemiImplicitEuler::advance(State& state, const Vertices& force) {
  // Where nothing changes the velocity in between, both updates are one pass.
  const bool at_once = system_.corrections.empty() && system_.filters.empty() && system_.pin_motions.empty();
  system_.begin(state);
  springs_.kick_and_drift(pull_, with_energies(state, force), at_once ? system_.step : 0, state.v, state.x);
  if (!at_once) {
    system_.correct(state);
    system_.move(state, nullptr);
  }
  return {};
}

const Vertices& SemiImplicitEuler::with_energies(const State& state, const Vertices& force) {
  if (system_.energies.empty()) return force;
  force_.setZero(force.rows(), 3);
  for (const auto& energy : system_.energies) energy->add_gradient(state.x, system_.time(state.step), force_);
  force_ = force - force_;
  return force_;
}

}  // namespace drape
