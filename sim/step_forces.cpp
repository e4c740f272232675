#include "sim/step_forces.hpp"

#include <algorithm>

namespace drape {

StepForces::StepForces(const System& system, const State& start)
    : system_(system), constant_(Vertices::Zero(start.x.rows(), 3)), push_(&constant_) {
  for (const auto& force : system.forces) {
    if (force->constant()) force->add(start, 0, constant_);
  }
  force_ = constant_;
}

template <class Wanted>
const Vertices& StepForces::sum(const State& state, double time, const Wanted& wanted) {
  push_ = &constant_;
  for (const auto& force : system_.forces) {
    if (force->constant() || !wanted(*force)) continue;
    if (push_ == &constant_) force_ = constant_;
    push_ = &force_;
    force->add(state, time, force_);
  }
  return *push_;
}

const Vertices& StepForces::all(const State& state, double time) {
  return sum(state, time, [](const Force&) { return true; });
}

const Vertices& StepForces::position_forces(const State& state, double time) {
  return sum(state, time, [](const Force& force) { return !force.velocity_forces(); });
}

bool StepForces::any_of_velocity() const {
  return std::any_of(system_.forces.begin(), system_.forces.end(), [](const auto& f) { return f->velocity_forces(); });
}

void StepForces::velocity_forces(const State& state, double time, Vertices& force) const {
  force.setZero(state.x.rows(), 3);
  for (const auto& f : system_.forces) {
    if (f->velocity_forces()) f->add(state, time, force);
  }
}

void StepForces::note(const Vertices& velocity_forces) {
  force_ = *push_ + velocity_forces;
  push_ = &force_;
}

}  // namespace drape
