#pragma once

#include <functional>
#include <limits>
#include <memory>

#include "drape/sim/solvers/accuracy.hpp"
#include "drape/sim/state.hpp"
#include "sim/linear/constant_factor.hpp"
#include "sim/step_objective.hpp"

namespace drape {

/// A point of a minimisation, with the value and gradient of g.
struct Iterate {
  Vertices x;         ///< n×3 [m]
  Vertices gradient;  ///< ∇g(x), n×3, zero on pins [N]
  double value = 0;   ///< g(x) [J]
};

/// Model of the Hessian of g in a step with contact: Newton's, or Liu13's constant matrix A.
enum class ImplicitHessian { newton, constant };

/// Minimiser of the g of a step, StepObjective, over the free vertices. Solvers differ in the direction of an iteration
/// and share the stopping rule and the line search. No data carries over between steps, so the result depends only on g
/// and the starting point.
class Minimiser {
 public:
  /// @param objective of every step; must outlive this
  Minimiser(const System& system, const StepObjective& objective, const IntegratorSettings& settings,
            int default_max_iterations);
  virtual ~Minimiser() = default;
  Minimiser(const Minimiser&) = delete;
  Minimiser& operator=(const Minimiser&) = delete;

  /// Stores the error at the start of a step for its tolerance, see Accuracy.
  void begin_step(const Iterate& point) {
    start_error_ = objective_.error_bound(point.gradient);
    newton_error_ = std::numeric_limits<double>::infinity();
    tolerance_ = accuracy_.tolerance;
  }

  /// Moves the point, given with g's value and gradient, until the stopping rule is met. g never rises beyond rounding.
  /// @param may_end called after a small iteration; returns true if the point is acceptable
  /// @throws Interrupted, from any point
  StepReport minimise(Iterate& point, const std::function<bool()>& may_end);

  [[nodiscard]] const Accuracy& accuracy() const { return accuracy_; }
  /// Returns the tolerance at the end of the last minimisation [m] or [N], see Accuracy::tolerance_at().
  [[nodiscard]] double tolerance() const { return tolerance_; }

  /// Returns the estimated distance of the worst vertex from the minimum, after a minimisation [m]. Uses the error at
  /// which it stopped, or else a Newton step, which costs some iterations. A call does not affect later results.
  double error(const Iterate& point);

  /// Returns the factor of Liu13's matrix A of this system.
  virtual ConstantFactor& constant_factor();
  /// Returns the model of the Hessian for steps with contact.
  [[nodiscard]] virtual ImplicitHessian hessian() const { return ImplicitHessian::newton; }
  /// Returns the maximum number of iterations of a step.
  [[nodiscard]] int max_iterations() const { return max_iterations_; }

 protected:
  /// Begins another minimisation.
  virtual void start() {}
  /// Runs one iteration: moves the point and returns the 2-norm of its move over all unknowns [m].
  virtual double iterate(Iterate& point) = 0;

  /// Moves to x = point.x − length·direction for the first length of 1, 1/2, 1/4 … at which g decreases enough
  /// (Armijo's condition). g never rises beyond rounding.
  /// @param slope ∇g·direction, positive [J]
  /// @return the length, or 0 if none was found: the point is as low as rounding permits
  double descend(Iterate& point, const Vertices& direction, double slope);

  /// Records the Newton step of an iteration as an error estimate for its starting point. It uses the Hessian without
  /// its negative eigenvalues. The minimisation may end if the estimate is below a fraction of the tolerance.
  void note_newton_step(const Vertices& newton_step);

  /// Computes direction = H(x)⁻¹∇g, see NewtonSolver.
  virtual void find_newton_step(const Iterate& point, Vertices& direction) = 0;

  [[nodiscard]] const StepObjective& objective() const { return objective_; }

 private:
  /// Returns true if the point meets a gradient-based rule.
  /// @param change length of the last iteration's move [m]
  bool balanced(const Iterate& point, double change);

  const System& system_;
  const StepObjective& objective_;
  std::unique_ptr<ConstantFactor> factor_;  // created on first use
  Stop stop_;
  Accuracy accuracy_;
  double start_error_ = std::numeric_limits<double>::infinity();  // at the start of the step [m]
  double tolerance_;                                              // for the last point checked
  int max_iterations_;
  Iterate trial_;
  double least_error_ = 0;               // least error of this minimisation, with the error rule [m]
  int iterations_without_progress_ = 0;  // number of points since the least error
  double newton_error_ = std::numeric_limits<double>::infinity();  // by the last Newton step of an iteration [m]
};

}  // namespace drape
