#pragma once

#include "sim/settings.hpp"

namespace drape {

/// Limit of the automatic thread count. Beyond it loop overhead grows and memory bandwidth is exhausted
/// (docs/performance.md).
inline constexpr int most_automatic_threads = 16;

/// Returns the settings with the number of threads for the steps of a run.
/// @param asked number of threads; 0: as many as pay off and find an idle processor, only while they do
/// @param drawn true if frames are drawn and encoded at the same time, which reserves one processor
SimulationSettings with_threads(SimulationSettings settings, int asked, bool drawn);

}  // namespace drape
