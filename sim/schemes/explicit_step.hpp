#pragma once

#include "sim/system.hpp"

namespace drape {

/// What the explicit schemes share.

/// −h/m of each vertex, 0 on pins [s/kg]: by how much a gradient changes a velocity in a step.
Eigen::VectorXd explicit_pull(const System& system);

/// `force` with that of the energies at x and a time [N].
/// @param scratch holds the sum, if there are any
const Vertices& with_energies(const System& system, const Vertices& x, double time, const Vertices& force,
                              Vertices& scratch);

}  // namespace drape
