#pragma once

#include "sim/settings.hpp"

namespace drape {

class StepObjective;
struct System;

/// When a step is accurate enough: what [integrator] says, and what holds where it does not.
///
/// Without either, a step stops at an error in proportion to what it does, so that small motions are computed as well
/// as large ones, and rest is exact. It is the smaller of two. One is 0.1 r τ²a, of a scheme of order 2 0.05 r² τ²a,
/// about a tenth of what the scheme itself leaves out: an error δ is a force of Mδ/τ² that is not there, and a scheme
/// takes forces that change by a part r in a step for others that are about ½ rᵖ of them beside what they should be
/// (backward Euler: ½h²a' of a velocity, of ha). r is at most 1, and measured by a step that starts where the forces of
/// its beginning lead: their change is the error there. The other is 1 % of the longest way in the step, which counts
/// where forces are large but move nothing that is seen. Contact solved with the cloth has a rule of its own, see
/// ContactSolver.
struct Accuracy {
  StoppingRule rule;
  double tolerance;  ///< that is given [m], or [N] for StoppingRule::gradient
  bool usual;        ///< whether neither the rule nor the tolerance is given; then `tolerance` is 0.3 % of the way by
               ///< external forces in a step, or 10⁻⁴ of the cloth's size if that is less: what a step may leave
               ///< at least where no step is known
  int order;  ///< p

  /// @param inertia of every vertex in a step, m/h² [N/m]
  Accuracy(const IntegratorSettings& settings, const System& system, const Eigen::VectorXd& inertia);

  /// What a step may leave that ends at x: the tolerance, or where usual what follows from the step.
  /// @param start_error of where its minimisation began, rτ²a [m]
  [[nodiscard]] double tolerance_at(const StepObjective& objective, const Vertices& x, double start_error) const;
};

/// How many iterations end a step by default: 2000 where it stops at an error, which must be reached.
/// @param otherwise a method's own number
int default_iterations(const IntegratorSettings& settings, int otherwise);

}  // namespace drape
