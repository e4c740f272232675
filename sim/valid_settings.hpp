#pragma once

#include "sim/settings.hpp"

namespace drape {

/// Looks at what a program has set before anything is computed from it: the step is positive, every list of the cloth
/// has an entry for each vertex (rest may be empty), and triangles, springs and pins name vertices that there are.
/// @throws UsageError that says what was expected and found
void require_valid(const SimulationSettings& settings);

}  // namespace drape
