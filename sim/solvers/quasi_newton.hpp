#pragma once

#include <optional>

#include "sim/solvers/factored_minimiser.hpp"
#include "sim/solvers/lbfgs_history.hpp"
#include "sim/solvers/patch_newton.hpp"

namespace drape {

/// L-BFGS on g with Liu13's matrix A as the initial Hessian (Liu, Bouaziz and Kavan, "Quasi-Newton Methods for
/// Real-Time Simulation of Hyperelastic Materials", 2017, section 4). Each iteration scales A to the last curvature
/// (Nocedal and Wright 2006, eq. 7.20), which saves a third of the iterations. A line search keeps g from rising.
///
/// Two changes apply to a fine cloth with the error rule. If only springs hold the cloth together, some iterations use
/// Newton's method on patches (PatchNewton), as few vertices exceed the tolerance after some iterations. Others are
/// Newton steps on the whole cloth, by a few conjugate gradients. They estimate the distance from the minimum when the
/// gradient does not, see docs/accuracy.md.
class QuasiNewton final : public FactoredMinimiser {
 public:
  QuasiNewton(const System& system, const StepObjective& objective, const IntegratorSettings& settings);

 private:
  void start() override;
  double iterate(Iterate& point) override;
  // Runs an iteration of another kind if one is due; returns the length of the point's move [m].
  double settle_patches(Iterate& point);
  double take_newton_step(Iterate& point);

  LbfgsHistory history_;
  Vertices preconditioned_;  // A⁻¹∇g at the point
  Vertices direction_;
  bool looks_ = false;   // true if some iterations are Newton steps
  int before_look_ = 0;  // number of other iterations before the first Newton step
  int until_look_ = 0;   // number of other iterations before the next Newton step
  int gap_ = 0;          // number of other iterations between the next two Newton steps
  std::optional<PatchNewton> patches_;
  int wait_ = 0;   // number of iterations until the next patch iteration
  int round_ = 0;  // number of consecutive patch iterations so far
};

}  // namespace drape
