#pragma once

#include <optional>

#include "sim/schemes/field_kick.hpp"
#include "sim/schemes/scheme.hpp"
#include "sim/spring_network.hpp"

namespace drape {

/// Velocity Verlet in its position form: x += h/2·v, v += h·a(x), x += h/2·v. It is symplectic, reversible and of
/// second order, as the form that begins and ends with half a kick is: their motions are the same but for half a step
/// of drifting before and after (measured, their errors differ by 7% at most, either way). This one evaluates the
/// forces once in a step without keeping any from the step before, so a step depends on nothing but the state, and both
/// positions and velocities are those of its end.
///
/// Forces that depend on the place are those of the middle of the step. Those that depend on the velocities (air) are
/// evaluated there too, with the velocities of the start and with those that follow from them at the end, and their
/// mean is taken. With the kick that is the two-stage Runge-Kutta method which is a mean of steps of Euler's (Shu and
/// Osher 1988): where none of these gives energy, it gives none. Velocity fields are solved for by
/// the implicit midpoint rule, see FieldKick. What corrections do is halved. All of that keeps the second order.
/// Filters do not: their change of the way is an impulse at an unknown time within the step.
class Verlet final : public Scheme {
 public:
  /// @throws UsageError if the system has energies that are solved for
  explicit Verlet(const System& system);
  StepReport advance(State& state, StepForces& forces) override;

 private:
  /// Adds to the velocities what forces do that depend on them; they were start_v_ before the kick. Returns whether
  /// what the fields do was found.
  bool kick_of_velocity(State& state, double time, StepForces& forces);
  /// The part of those that are evaluated for it.
  void add_of_velocity(State& state, double time, StepForces& forces);

  const System& system_;
  SpringNetwork springs_;
  Eigen::VectorXd pull_;  // −h/m of each vertex, 0 on pins [s/kg]
  Vertices start_x_, start_v_, way_;
  Vertices force_, more_force_;  // [N]
  Vertices before_;              // the velocities before the kick [m/s]
  std::optional<FieldKick> fields_;
};

}  // namespace drape
