#include "sim/integrators/semi_implicit.hpp"

namespace drape {

SemiImplicitEuler::SemiImplicitEuler(const System& system)
    : system_(system),
      springs_(system.springs),
      push_(system.step * system.cloth.masses.cwiseInverse()),
      gradient_(system.cloth.vertex_count(), 3) {
  for (const int pin : system.cloth.pins) push_[pin] = 0;
  pull_ = -push_;
}

StepReport SemiImplicitEuler::advance(State& state, const Vertices& force) {
  const Kernels& k = kernels();
  const auto count = static_cast<std::size_t>(state.x.rows());
  gradient_.setZero();
  springs_.add_gradient(state.x, gradient_);
  for (int axis = 0; axis < 3; ++axis) {
    double* v = state.v.col(axis).data();
    k.accelerate(count, push_.data(), force.col(axis).data(), v);
    k.accelerate(count, pull_.data(), gradient_.col(axis).data(), v);
  }
  system_.correct(state);
  k.drift(3 * count, system_.step, state.v.data(), state.x.data());
  return {};
}

}  // namespace drape
