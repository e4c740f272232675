#pragma once

#include "sim/system.hpp"

namespace drape {

/// What acts on a cloth in a step, evaluated where and when a scheme asks for it. What is the same in every state is
/// summed once.
class StepForces {
 public:
  /// @param system may be made anew at the same place for a cloth with other pins
  StepForces(const System& system, const State& start);

  /// The sum of all forces in a state at a time [s], n×3 [N]. Holds until the next call.
  const Vertices& all(const State& state, double time);

  /// Of those that do not depend on the velocities.
  const Vertices& of_place(const State& state, double time);

  /// Whether any depends on the velocities.
  [[nodiscard]] bool any_of_velocity() const;
  /// force = the sum of those that do.
  void of_velocity(const State& state, double time, Vertices& force) const;
  /// Takes note of what those did in the step on average [N].
  void note(const Vertices& of_velocity);

  /// What acted in the last step on average, as far as the scheme has asked for it and taken note, for books of its
  /// work.
  [[nodiscard]] const Vertices& push() const { return *push_; }
  /// Whether that is the same in every step.
  [[nodiscard]] bool constant() const { return push_ == &constant_; }

 private:
  template <class Wanted>
  const Vertices& sum(const State& state, double time, const Wanted& wanted);

  const System& system_;
  Vertices constant_, force_;
  const Vertices* push_;
};

}  // namespace drape
