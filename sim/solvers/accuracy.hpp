#pragma once

#include "sim/settings.hpp"

namespace drape {

struct System;

/// When a step is accurate enough: what [integrator] says, and what holds where it does not.
///
/// Without a tolerance a step stops at an error. That is the smaller of two: 10⁻⁴ of the cloth's size, which nobody
/// sees; and 0.003 of the way that the external forces move a vertex in the step, h²a. An error δ of every step is a
/// force of Mδ/h² that is not there, so the cloth is computed with its external forces known to 0.3 %, whatever the
/// step: a tolerance from the size alone would let it freeze where steps are small. Where no external force is constant
/// in time, what counts in its place is what moves the cloth at the start: its velocities, and all forces on it.
struct Accuracy {
  StoppingRule rule;
  double tolerance;  ///< [m], or [N] for StoppingRule::gradient
  bool usual;        ///< whether neither the rule nor the tolerance is given

  /// @param inertia of every vertex in a step, m/h² [N/m]
  Accuracy(const IntegratorSettings& settings, const System& system, const Eigen::VectorXd& inertia);
};

/// How many iterations end a step by default: 2000 where it stops at an error, which must be reached.
/// @param otherwise a method's own number
int default_iterations(const IntegratorSettings& settings, int otherwise);

}  // namespace drape
