#pragma once

#include "sim/system.hpp"

namespace drape {

/// Helpers of the explicit schemes.

/// Returns −h/m of each vertex, 0 on pins [s/kg]: the change of velocity in a step per unit of gradient.
Eigen::VectorXd explicit_pull(const System& system);

/// Returns `force` plus the forces of the energies at x and a time [N].
/// @param scratch holds the sum if there are energies
const Vertices& with_energies(const System& system, const Vertices& x, double time, const Vertices& force,
                              Vertices& scratch);

}  // namespace drape
