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
  /// Where the minimisation is, with what g is there.
  struct Point {
    Vertices x;         ///< n×3 [m]
    Vertices gradient;  ///< ∇g(x), n×3, zero on pins [N]
    double value = 0;   ///< g(x) [J]
  };

  ImplicitEuler(const System& system, const IntegratorSettings& settings, int default_max_iterations);

  /// Begins the minimisation of another step.
  virtual void start() {}
  /// One iteration: moves the point, and returns how far [m], the 2-norm over all unknowns.
  virtual double iterate(Point& point) = 0;

  /// Tries x = point.x − length·direction with lengths 1, 1/2, 1/4 … until g decreases enough (Armijo's condition), and
  /// moves the point there, so that g never rises beyond rounding.
  /// @param slope ∇g·direction, positive [J]
  /// @return the length, or 0 where none was found: the point is as low as it can be computed
  double descend(Point& point, const Vertices& direction, double slope);

  [[nodiscard]] const StepObjective& objective() const { return objective_; }

 private:
  StepReport minimise();

  const System& system_;
  StoppingRule stop_;
  double tolerance_;
  int max_iterations_;
  StepObjective objective_;
  Point point_, trial_;
};

}  // namespace drape
