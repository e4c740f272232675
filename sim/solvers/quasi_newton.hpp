#pragma once

#include <optional>

#include "sim/solvers/factored_minimiser.hpp"
#include "sim/solvers/lbfgs_history.hpp"
#include "sim/solvers/patch_newton.hpp"

namespace drape {

/// L-BFGS on g with Liu13's matrix A as the initial Hessian (Liu, Bouaziz and Kavan, "Quasi-Newton
/// Methods for Real-Time Simulation of Hyperelastic Materials", 2017, section 4), scaled in every iteration to the
/// curvature last seen (Nocedal and Wright 2006, eq. 7.20), which saves a third of the iterations. A line search keeps
/// g from rising.
///
/// Two things are different for a fine cloth, where a step stops at an error. Some iterations are Newton's on patches
/// alone (PatchNewton), if nothing but springs holds the cloth together: after a few iterations the error is above the
/// tolerance in few places. And some are Newton's on all of the cloth, by a few conjugate gradients: they say how far
/// the minimum is where the gradient does not, see docs/accuracy.md.
class QuasiNewton final : public FactoredMinimiser {
 public:
  QuasiNewton(const System& system, const StepObjective& objective, const IntegratorSettings& settings);

 private:
  void start() override;
  double iterate(Iterate& point) override;
  // An iteration of another kind, if it is time for one; they return how far that moved the point [m].
  double settle_patches(Iterate& point);
  double take_newton_step(Iterate& point);

  LbfgsHistory history_;
  Vertices preconditioned_;  // A⁻¹∇g at the point
  Vertices direction_;
  bool looks_ = false;   // whether some iterations are Newton's…
  int before_look_ = 0;  // …how many others there are before the first…
  int until_look_ = 0;   // …and until the next…
  int gap_ = 0;          // …and from there to the one after it
  std::optional<PatchNewton> patches_;
  int wait_ = 0;   // iterations until patches are looked at…
  int round_ = 0;  // …and how many there were on them just now
};

}  // namespace drape
