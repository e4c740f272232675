#pragma once

#include <functional>
#include <optional>

#include "sim/contact/contact_solver.hpp"
#include "sim/schemes/energy_books.hpp"
#include "sim/schemes/minimising_scheme.hpp"

namespace drape {

/// Backward (implicit) Euler as a minimisation: x' = argmin g, v' = (x' − x)/h, then the corrections. It gains no
/// energy beyond the tolerance of EnergyBooks.
///
/// For a free cloth every solve ends with balance_momentum().
class BackwardEuler final : public MinimisingScheme {
 public:
  /// @param instantaneous true if velocities are instantaneous, as in steps of SDIRK2; false if they are step means
  BackwardEuler(const System& system, const MakeSolver& make_solver, bool instantaneous = false);

  StepReport advance(State& state, StepForces& forces) override;

  [[nodiscard]] double residual() override;
  [[nodiscard]] double error() override;
  [[nodiscard]] double residual_force() override;

  /// Returns true if contacts keep a cloth from moving straight from a state to x in the step that begins there.
  /// Requires something that the cloth can touch.
  [[nodiscard]] bool is_blocked_by_contact(const State& from, const Vertices& x);

 private:
  /// Shortens the step until it gains no energy, along a path free of collisions. Returns the remaining fraction.
  /// @param held true if contacts hold the cloth
  double shed(bool held);

  /// Minimises the objective from the point, under the contacts of a step that began at contact_->begin().
  /// @param steady positions reached at constant velocities; empty without contacts
  StepReport solve_step(const Vertices& steady, const std::function<bool()>& may_end);

  bool of_the_moment_;
  EnergyBooks books_;
  std::optional<ContactSolver> contact_;    // if the cloth can touch anything
  std::optional<ImplicitProblem> problem_;  // of contact, created on first use
  bool touched_ = false;                    // true if the last step had contacts
};

}  // namespace drape
