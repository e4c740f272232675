#include "sim/step_objective.hpp"

#include <limits>

namespace drape {

StepObjective::StepObjective(const System& system)
    : system_(system),
      springs_(system.springs),
      inertia_(system.cloth.masses / (system.step * system.step)),
      push_(inertia_.cwiseInverse()),
      y_(system.cloth.vertex_count(), 3) {
  for (const int pin : system.cloth.pins) push_[pin] = 0;
}

void StepObjective::begin(const State& state, const Vertices& force) {
  const Kernels& k = kernels();
  const auto count = static_cast<std::size_t>(state.x.rows());
  y_ = state.x;
  k.drift(3 * count, system_.step, state.v.data(), y_.data());
  for (int axis = 0; axis < 3; ++axis) {
    k.accelerate(count, push_.data(), force.col(axis).data(), y_.col(axis).data());
  }
}

double StepObjective::value(const Vertices& x) const {
  return 0.5 * inertia_.dot((x - y_).rowwise().squaredNorm()) + springs_.energy(x);
}

double StepObjective::rounding(double value) {
  // Every term of g is positive, so its sum has a relative error of a few units in the last place of each.
  return 64 * std::numeric_limits<double>::epsilon() * value;
}

void StepObjective::gradient(const Vertices& x, Vertices& gradient) const {
  const auto count = static_cast<std::size_t>(x.rows());
  for (int axis = 0; axis < 3; ++axis) {
    kernels().scaled_difference(count, inertia_.data(), x.col(axis).data(), y_.col(axis).data(),
                                gradient.col(axis).data());
  }
  springs_.add_gradient(x, gradient);
  for (const int pin : system_.cloth.pins) gradient.row(pin).setZero();
}

}  // namespace drape
