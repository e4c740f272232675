#pragma once

#include <functional>
#include <limits>
#include <memory>

#include "sim/linear/constant_factor.hpp"
#include "sim/solvers/accuracy.hpp"
#include "sim/step_objective.hpp"
#include "sim/step_report.hpp"

namespace drape {

/// Where a minimisation is, with what g is there.
struct Iterate {
  Vertices x;         ///< n×3 [m]
  Vertices gradient;  ///< ∇g(x), n×3, zero on pins [N]
  double value = 0;   ///< g(x) [J]
};

/// What stands for the Hessian of g in a step with contact: Newton's, or Liu13's constant matrix A.
enum class ImplicitHessian { newton, constant };

/// Minimises the g of a step, StepObjective, over the free vertices. Solvers differ in the direction of an iteration;
/// they share the stopping rule and the line search. Nothing is carried from one step to the next, so that its result
/// depends on g and on where it begins alone.
class Minimiser {
 public:
  /// @param objective of every step, which must outlive this
  Minimiser(const System& system, const StepObjective& objective, const IntegratorSettings& settings,
            int default_max_iterations);
  virtual ~Minimiser() = default;
  Minimiser(const Minimiser&) = delete;
  Minimiser& operator=(const Minimiser&) = delete;

  /// Takes note of where a step begins, see Accuracy: its minimisations will depend on that, too.
  void begin_step(const Iterate& point) { start_error_ = objective_.error_bound(point.gradient); }

  /// Moves the point, which has g's value and gradient already, until the stopping rule is met. No iteration raises g
  /// beyond rounding.
  /// @param may_end asked where an iteration changes little, whether the point will do
  /// @throws Interrupted, from any point
  StepReport minimise(Iterate& point, const std::function<bool()>& may_end);

  [[nodiscard]] const Accuracy& accuracy() const { return accuracy_; }
  /// What the last minimisation might leave where it ended [m], or [N], see Accuracy::tolerance_at().
  [[nodiscard]] double tolerance() const { return tolerance_; }

  /// How far the worst vertex is from the minimum, estimated where a minimisation has ended [m]: the error that it
  /// stopped at, or else Newton's step from there, which costs some iterations. Nothing of what comes after depends on
  /// whether it was asked for.
  double error(const Iterate& point);

  /// Factor of Liu13's matrix A of this system.
  virtual ConstantFactor& constant_factor();
  /// Model of the Hessian that steps with contact use.
  [[nodiscard]] virtual ImplicitHessian hessian() const { return ImplicitHessian::newton; }
  /// Most iterations of a step.
  [[nodiscard]] int max_iterations() const { return max_iterations_; }

 protected:
  /// Begins another minimisation.
  virtual void start() {}
  /// One iteration: moves the point, and returns how far [m], the 2-norm over all unknowns.
  virtual double iterate(Iterate& point) = 0;

  /// Tries x = point.x − length·direction with lengths 1, 1/2, 1/4 … until g decreases enough (Armijo's condition), and
  /// moves the point there, so that g never rises beyond rounding.
  /// @param slope ∇g·direction, positive [J]
  /// @return the length, or 0 where none was found: the point is as low as it can be computed
  double descend(Iterate& point, const Vertices& direction, double slope);

  /// Tells that an iteration went along Newton's step from where it began: so far was the minimum from there, by the
  /// Hessian without its negative eigenvalues. Where it was within a part of the tolerance, the point will do.
  void went_along(const Vertices& newton_step);

  /// direction = H(x)⁻¹∇g, see NewtonSolver.
  virtual void find_newton_step(const Iterate& point, Vertices& direction) = 0;

  [[nodiscard]] const StepObjective& objective() const { return objective_; }

 private:
  /// Whether the point will do by a rule that looks at the gradient.
  /// @param change how far the last iteration has moved the point [m]
  bool balanced(const Iterate& point, double change);

  const System& system_;
  const StepObjective& objective_;
  std::unique_ptr<ConstantFactor> factor_;  // once it is asked for
  Stop stop_;
  Accuracy accuracy_;
  double start_error_ = std::numeric_limits<double>::infinity();  // where the step began [m]
  double tolerance_;                                              // of the point that was last looked at
  int max_iterations_;
  Iterate trial_;
  double least_error_ = 0;   // that a point of this minimisation had, where it stops at an error…
  int in_vain_ = 0;          // …and how many points had none that was less since
  double newton_error_ = 0;  // by the last of Newton's steps that an iteration went along
};

}  // namespace drape
