#pragma once

#include <functional>

#include "sim/settings.hpp"
#include "sim/step_objective.hpp"
#include "sim/step_report.hpp"

namespace drape {

/// Where a minimisation is, with what g is there.
struct Point {
  Vertices x;         ///< n×3 [m]
  Vertices gradient;  ///< ∇g(x), n×3, zero on pins [N]
  double value = 0;   ///< g(x) [J]
};

/// Minimises the g of a step, StepObjective, over the free vertices. Solvers differ in the direction of an iteration;
/// they share the stopping rule and the line search. Nothing is carried from one minimisation to the next, so that its
/// result depends on g and on where it begins alone.
class Minimiser {
 public:
  /// @param objective of every step, which must outlive this
  Minimiser(const StepObjective& objective, const IntegratorSettings& settings, int default_max_iterations);
  virtual ~Minimiser() = default;
  Minimiser(const Minimiser&) = delete;
  Minimiser& operator=(const Minimiser&) = delete;

  /// Moves the point, which has g's value and gradient already, until the stopping rule is met. No iteration raises g
  /// beyond rounding.
  /// @param may_end asked where an iteration changes little, whether the point will do
  StepReport minimise(Point& point, const std::function<bool()>& may_end);

 protected:
  /// Begins another minimisation.
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
  const StepObjective& objective_;
  StoppingRule stop_;
  double tolerance_;
  int max_iterations_;
  Point trial_;
};

}  // namespace drape
