#pragma once

#include <memory>

#include "sim/linear/newton_solver.hpp"
#include "sim/solvers/minimiser.hpp"

namespace drape {

/// Newton's method on g, with a backtracking line search. It starts with the Hessian without its negative eigenvalues,
/// whose directions also descend far from the minimum. After an iteration that did not halve ‖∇g‖, it keeps as many
/// negative eigenvalues as leave the Hessian positive definite. Without them compressed cloth is too stiff and
/// convergence slow; with them convergence is quadratic. The change rule uses the homework's iterations, which never
/// have any.
class Newton final : public Minimiser {
 public:
  Newton(const System& system, const StepObjective& objective, const IntegratorSettings& settings);

 private:
  void start() override;
  double iterate(Iterate& point) override;
  void find_newton_step(const Iterate& point, Vertices& direction) override;

  std::unique_ptr<NewtonSolver> solver_;
  double concavity_ = 0;
  Vertices direction_;
};

}  // namespace drape
