#pragma once

#include "drape/sim/settings.hpp"

namespace drape {

class StepObjective;
struct System;

/// Stopping criterion of a step: from [integrator], or the following default.
///
/// Without a rule and a tolerance, a step stops at an error proportional to its motion. So small motions are as
/// accurate as large ones, and rest is exact. The tolerance is the smaller of two. The first is 0.1 r τ²a, or 0.05 r²
/// τ²a for a scheme of order 2: about a tenth of the scheme's own error. An error δ amounts to a missing force of
/// Mδ/τ². If forces change by the fraction r in a step, a scheme's forces err by about ½ rᵖ of their size (backward
/// Euler: ½h²a' of a velocity, relative to ha). r is at most 1; it is the start error of the minimisation, relative to
/// τ²a. The second is 1 % of the longest displacement in the step, for large forces that move little. Contact solved
/// with the cloth has its own rule, see ContactSolver.
struct Accuracy {
  StoppingRule rule;
  double tolerance;  ///< given tolerance [m], or [N] for StoppingRule::gradient
  /// True if neither rule nor tolerance is given; `tolerance` is then 0.3 % of the largest displacement by external
  /// forces in a step, at most 10⁻⁴ of the cloth's size: the least tolerance, used before a step is known.
  bool is_default;
  int order;     ///< order p of the scheme
  double limit;  ///< largest default tolerance, from System::solve_limit [m]

  /// @param inertia of every vertex in a step, m/h² [N/m]
  Accuracy(const IntegratorSettings& settings, const System& system, const Eigen::VectorXd& inertia);

  /// Returns the tolerance for a step that ends at x; by default it depends on the step.
  /// @param start_error at the start of its minimisation, rτ²a [m]
  [[nodiscard]] double tolerance_at(const StepObjective& objective, const Vertices& x, double start_error) const;
};

/// Returns the default maximum number of iterations: 2000 for the error rule, which must be met.
/// @param otherwise default of the method for other rules
int default_iterations(const IntegratorSettings& settings, int otherwise);

}  // namespace drape
