#pragma once

#include "sim/settings.hpp"

namespace drape {

/// Validates settings before a computation. The step must be positive, and every list of the cloth must have an entry
/// for each vertex (rest may be empty). Triangles, springs and pins must refer to existing vertices.
/// @throws UsageError with the expected and the found value
void require_valid(const SimulationSettings& settings);

}  // namespace drape
