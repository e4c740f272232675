#pragma once

#include <optional>

#include "sim/dashpots.hpp"
#include "sim/schemes/field_solve.hpp"
#include "sim/schemes/scheme.hpp"
#include "sim/spring_network.hpp"
#include "sim/system.hpp"

namespace drape {

/// Returns −h/m of each vertex, 0 on pins [s/kg]: the change of velocity in a step per unit of gradient.
Eigen::VectorXd explicit_pull(const System& system);

/// Returns `force` plus the forces of the energies at x and a time [N].
/// @param scratch holds the sum if there are energies
const Vertices& with_energies(const System& system, const Vertices& x, double time, const Vertices& force,
                              Vertices& scratch);

/// Symplectic (semi-implicit) Euler: v += h·a(x), the dashpots by DampingKick, velocity fields by
/// FieldKick, the corrections, x += h·v.
class SemiImplicitEuler final : public Scheme {
 public:
  /// @throws UsageError if the system has energies that only implicit methods support
  explicit SemiImplicitEuler(const System& system);
  StepReport advance(State& state, StepForces& forces) override;
  std::int64_t advance_at_once(State& state, StepForces& forces, std::int64_t left) override;
  [[nodiscard]] std::optional<double> size() const override { return size_; }

 private:
  const System& system_;
  const SpringNetwork& springs_;
  Eigen::VectorXd pull_;         // −h/m of each vertex, 0 on pins [s/kg]
  std::optional<double> decay_;  // see System::decay
  bool alike_;                   // steps have nothing but springs, constant forces and that decay
  std::optional<double> size_;
  Vertices force_;                      // plus those of energies; empty without [N]
  Vertices before_;                     // velocities before the kick, if there are fields or dashpots [m/s]
  std::optional<DampingKick> damping_;  // if there are dashpots
  std::optional<FieldKick> fields_;
};

/// Velocity Verlet in its position form: x += h/2·v, v += h·a(x), x += h/2·v. Like the form with half kicks it is
/// symplectic, reversible and of second order. Both give the same motion except for half a step of drift at either end
/// (measured errors differ by at most 7%). This form evaluates the forces once per step and keeps none from the last
/// step. So a step depends only on the state, and positions and velocities both belong to its end.
///
/// Forces that depend on the position are evaluated at mid-step. Those that depend on velocities (air) are averaged
/// there over the initial velocities and the resulting final ones. With the kick this is the two-stage Runge-Kutta
/// method that averages Euler steps (Shu and Osher 1988): if none of these adds energy, it adds none. Velocity fields
/// use the implicit midpoint rule, see FieldKick. Dashpots act between two halves of the kick (DampingKick), or in two
/// halves around it if forces depend on velocities. Corrections are applied in two halves. All of this has second
/// order. Filters do not: their change of the path is an impulse at an unknown time within the step.
class Verlet final : public Scheme {
 public:
  /// @throws UsageError if the system has energies that only implicit methods support
  explicit Verlet(const System& system);
  StepReport advance(State& state, StepForces& forces) override;
  std::int64_t advance_at_once(State& state, StepForces& forces, std::int64_t left) override;
  [[nodiscard]] std::optional<double> size() const override { return size_; }

 private:
  /// Adds the effect of all forces at a time [s] to the velocities, then moves the vertices. Returns true if
  /// the solve for velocity fields converged.
  bool kick(State& state, double time, StepForces& forces, const Drift& drift);
  /// Does the same, with the dashpots and without moving the vertices.
  bool kick_with_dashpots(State& state, double time, StepForces& forces);
  /// Adds the effect of velocity-dependent forces to the velocities, which were start_v_ before the kick. Returns true
  /// if the solve for velocity fields converged.
  bool apply_velocity_forces(State& state, double time, StepForces& forces);
  /// Adds the effect of velocity-dependent forces outside of fields, the mean of those at both ends of the kick.
  void add_velocity_forces(State& state, double time, StepForces& forces);

  const System& system_;
  const SpringNetwork& springs_;
  Eigen::VectorXd pull_;              // −h/m of each vertex, 0 on pins [s/kg]
  std::optional<double> half_decay_;  // of half a step, see System::decay
  bool alike_;                        // steps have nothing but springs, constant forces and that decay
  std::optional<double> size_;
  Vertices start_x_, start_v_, way_;
  Vertices force_, more_force_;  // [N]
  Vertices before_;              // velocities before the kick [m/s]
  // If there are dashpots: in the middle of a kick, or before and after it if forces depend on velocities.
  std::optional<DampingKick> damping_, half_damping_;
  std::optional<FieldKick> fields_;
};

}  // namespace drape
