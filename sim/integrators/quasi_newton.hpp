#pragma once

#include "sim/integrators/implicit_euler.hpp"
#include "sim/integrators/secant_history.hpp"
#include "sim/linear/constant_factor.hpp"

namespace drape {

/// Implicit Euler by L-BFGS on g with Liu13's matrix A as the initial Hessian (Liu, Bouaziz and Kavan, "Quasi-Newton
/// Methods for Real-Time Simulation of Hyperelastic Materials", 2017, section 4), scaled in every iteration to the
/// curvature last seen (Nocedal and Wright 2006, eq. 7.20), which saves a third of the iterations. A line search keeps
/// g from rising. Nothing is carried from one step to the next, so that a step depends on its state alone.
class QuasiNewton final : public ImplicitEuler {
 public:
  QuasiNewton(const System& system, const IntegratorSettings& settings);

 private:
  void start() override;
  double iterate(Point& point) override;

  ConstantFactor factor_;
  SecantHistory history_;
  Vertices preconditioned_;  // A⁻¹∇g at the point
  Vertices direction_;
};

}  // namespace drape
