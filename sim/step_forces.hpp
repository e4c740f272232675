#pragma once

#include "sim/system.hpp"

namespace drape {

/// Forces on a cloth in a step, evaluated at the states and times that a scheme requests. Constant forces are summed
/// once.
class StepForces {
 public:
  /// @param system may be replaced in place by one for a cloth with other pins
  StepForces(const System& system, const State& start);

  /// Returns the sum of all forces at a state and a time [s], n×3 [N]. Valid until the next call.
  const Vertices& all(const State& state, double time);

  /// Returns the sum of forces that do not depend on velocities.
  const Vertices& position_forces(const State& state, double time);

  /// Returns true if any force depends on velocities.
  [[nodiscard]] bool any_of_velocity() const;
  /// Sets force = the sum of forces that depend on velocities.
  void velocity_forces(const State& state, double time, Vertices& force) const;
  /// Records the mean of velocity-dependent forces in the step [N].
  void note(const Vertices& velocity_forces);

  /// Returns the mean force in the last step, as far as evaluated and recorded, for the energy balance [N].
  [[nodiscard]] const Vertices& push() const { return *push_; }
  /// Returns true if the mean force is the same in every step.
  [[nodiscard]] bool constant() const { return push_ == &constant_; }

 private:
  template <class Wanted>
  const Vertices& sum(const State& state, double time, const Wanted& wanted);

  const System& system_;
  Vertices constant_, force_;
  const Vertices* push_;
};

}  // namespace drape
