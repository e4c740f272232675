#pragma once

#include "sim/integrators/integrator.hpp"
#include "sim/step_objective.hpp"

namespace drape {

/// Implicit Euler as a minimisation: x' = argmin g, v' = (x' − x)/h, then the corrections. The methods differ in the
/// direction that an iteration goes.
class ImplicitEuler : public Integrator {
 public:
  StepReport advance(State& state, const Vertices& force) final;
  [[nodiscard]] double residual() final;

 protected:
  ImplicitEuler(const System& system, const IntegratorSettings& settings, int default_max_iterations);

  /// One iteration: moves x from a point where g has this gradient, and returns how far [m], the 2-norm over all
  /// unknowns.
  virtual double iterate(Vertices& x, const Vertices& gradient) = 0;

  [[nodiscard]] const StepObjective& objective() const { return objective_; }

 private:
  StepReport minimise();

  const System& system_;
  StoppingRule stop_;
  double tolerance_;
  int max_iterations_;
  StepObjective objective_;
  Vertices x_, gradient_;
};

}  // namespace drape
