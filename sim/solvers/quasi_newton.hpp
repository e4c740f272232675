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
/// Of a large cloth that nothing but springs hold together some iterations are Newton's on patches alone (PatchNewton),
/// where a step stops at an error: after a few iterations that is above the tolerance in few places.
class QuasiNewton final : public FactoredMinimiser {
 public:
  QuasiNewton(const System& system, const StepObjective& objective, const IntegratorSettings& settings);

 private:
  void start() override;
  double iterate(Iterate& point) override;
  /// An iteration on patches, if it is time for one; returns how far that moved the point [m].
  double settle_patches(Iterate& point);

  LbfgsHistory history_;
  Vertices preconditioned_;  // A⁻¹∇g at the point
  Vertices direction_;
  std::optional<PatchNewton> patches_;
  int wait_ = 0;   // iterations until patches are looked at…
  int round_ = 0;  // …and how many there were on them just now
};

}  // namespace drape
