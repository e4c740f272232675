#pragma once

#include "drape/scene/scene.hpp"
#include "drape/sim/settings.hpp"
#include "run/run_scene.hpp"

namespace drape {

/// Limit of the automatic thread count. Beyond it loop overhead grows and memory bandwidth is exhausted
/// (docs/notes/performance.md).
inline constexpr int most_automatic_threads = 16;

/// Returns the settings with the number of threads for the steps of a run.
/// @param asked number of threads; 0: as many as pay off and find an idle processor, only while they do
/// @param drawn true if frames are drawn and encoded at the same time, which reserves one processor
SimulationSettings with_threads(SimulationSettings settings, int asked, bool drawn);

/// Estimates the time of a run on a processor of 2022, within a factor of about three [s]. Depends only on the method,
/// the effects and the numbers of steps, springs, vertices and pixels, so every machine assigns shards alike.
double estimated_cost(const Scene& scene, const RunOptions& options);

}  // namespace drape
