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

  BackwardEuler(const System& system, const IntegratorSettings& settings, const MakeSolver& make_solver);

  StepReport advance(State& state, StepForces& forces) override;
  [[nodiscard]] double residual() override { return norm(point_.gradient); }

 private:
  const System& system_;
  StepObjective objective_;
  StoppingRule stop_;
  std::unique_ptr<Minimiser> solver_;
  EnergyBooks books_;
  Point point_;
  bool free_;  // see is_free()
};

}  // namespace drape
