#pragma once

#include <functional>
#include <memory>

#include "sim/schemes/energy_books.hpp"
#include "sim/schemes/scheme.hpp"
#include "sim/solvers/minimiser.hpp"

namespace drape {

/// Backward (implicit) Euler as a minimisation: x' = argmin g, v' = (x' − x)/h, then the corrections. It gains no
/// energy but what EnergyBooks tolerates.
///
/// Of a cloth that nothing holds every solve ends with balance_momentum().
class BackwardEuler final : public Scheme {
 public:
  using MakeSolver = std::function<std::unique_ptr<Minimiser>(const StepObjective& objective)>;

  BackwardEuler(const System& system, const MakeSolver& make_solver);

  StepReport advance(State& state, StepForces& forces) override;
  [[nodiscard]] double residual() override { return norm(point_.gradient); }
  [[nodiscard]] double error() override { return solver_->error(point_); }
  [[nodiscard]] double unbalanced() override { return point_.gradient.rowwise().norm().sum(); }
  [[nodiscard]] std::optional<Accuracy> accuracy() const override { return solver_->accuracy(); }

 private:
  const System& system_;
  StepObjective objective_;
  std::unique_ptr<Minimiser> solver_;
  EnergyBooks books_;
  Iterate point_;
  bool free_;  // see is_free()
};

}  // namespace drape
