#pragma once

#include <functional>
#include <optional>

#include "sim/contact/contact_solver.hpp"
#include "sim/schemes/energy_books.hpp"
#include "sim/schemes/minimising_scheme.hpp"

namespace drape {

/// Backward (implicit) Euler as a minimisation: x' = argmin g, v' = (x' − x)/h, then the corrections. It gains no
/// energy but what EnergyBooks tolerates.
///
/// Of a cloth that nothing holds every solve ends with balance_momentum().
class BackwardEuler final : public MinimisingScheme {
 public:
  /// @param of_the_moment whether the velocities that it gets and leaves are those of the moment, not those with which
  ///                      the cloth goes: of steps among those of another scheme
  BackwardEuler(const System& system, const MakeSolver& make_solver, bool of_the_moment = false);

  StepReport advance(State& state, StepForces& forces) override;

  [[nodiscard]] double residual() override;
  [[nodiscard]] double error() override;
  [[nodiscard]] double unbalanced() override;

  /// Returns true if something keeps a cloth from going straight from a state to x in the step that begins there. There
  /// must be something that it can touch.
  [[nodiscard]] bool is_hindered(const State& from, const Vertices& x);

 private:
  /// Goes back until the step gains nothing, on a way that nothing is in; returns what part of it is left.
  /// @param held whether contacts hold the cloth
  double shed(bool held);

  /// Minimises the objective from the point, under the contacts of a step that began at contact_->begin().
  /// @param steady where cloth would go that keeps its velocities; empty without contacts
  StepReport solve_step(const Vertices& steady, const std::function<bool()>& may_end);

  bool of_the_moment_;
  EnergyBooks books_;
  std::optional<ContactSolver> contact_;    // where the cloth can touch something
  std::optional<ImplicitProblem> problem_;  // of contact, once there is any
  bool touched_ = false;                    // whether the last step had any
};

}  // namespace drape
