#pragma once

#include <memory>

#include "sim/linear/newton_solver.hpp"
#include "sim/solvers/minimiser.hpp"

namespace drape {

/// Newton's method on g, with a backtracking line search.
class Newton final : public Minimiser {
 public:
  Newton(const System& system, const StepObjective& objective, const IntegratorSettings& settings);

 private:
  double iterate(Iterate& point) override;
  void find_newton_step(const Iterate& point, Vertices& direction) override;

  std::unique_ptr<NewtonSolver> solver_;
  Vertices direction_;
};

}  // namespace drape
