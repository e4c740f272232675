#pragma once

#include <memory>

#include "sim/linear/newton_solver.hpp"
#include "sim/solvers/minimiser.hpp"

namespace drape {

/// Newton's method on g, with a backtracking line search. It begins with the Hessian without its negative eigenvalues,
/// along whose directions g falls far from the minimum, too. Once an iteration has not halved ‖∇g‖, the minimisation
/// goes on with as many of them as leave the Hessian positive definite: without them compressed cloth is too stiff, and
/// iterations creep to the minimum; with them they converge quadratically. A step that ends at a change has the
/// homework's iterations, which never have any.
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
