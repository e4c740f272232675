#include "sim/integrators/semi_implicit.hpp"

namespace drape {

SemiImplicitEuler::SemiImplicitEuler(const System& system)
    : system_(system),
      springs_(system.springs),
      pull_(-system.step * system.cloth.masses.cwiseInverse()),
      gradient_(Vertices::Zero(system.cloth.vertex_count(), 3)) {
  for (const int pin : system.cloth.pins) pull_[pin] = 0;
}

StepReport SemiImplicitEuler::advance(State& state, const Vertices& force) {
  const Kernels& k = kernels();
  const auto count = static_cast<std::size_t>(state.x.rows());
  springs_.add_gradient(state.x, gradient_);
  // Where nothing changes the velocity in between, both updates are one pass.
  const bool straight = system_.corrections.empty() && system_.filters.empty() && system_.pin_motions.empty();
  const double drift = straight ? system_.step : 0;
  for (int axis = 0; axis < 3; ++axis) {
    k.kick_and_drift(count, pull_.data(), force.col(axis).data(), drift, gradient_.col(axis).data(),
                     state.v.col(axis).data(), state.x.col(axis).data());
  }
  if (!straight) {
    system_.correct(state);
    system_.drive_pins(state);
    system_.filter(state);
    k.add_multiple(3 * count, system_.step, state.v.data(), state.x.data());
    system_.place_pins(state, state.x);
  }
  return {};
}

}  // namespace drape
