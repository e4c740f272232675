#pragma once

#include "run/run_scene.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Estimates the time of a run on a processor of 2022, within a factor of about three [s]. Depends only on the method,
/// the effects and the numbers of steps, springs, vertices and pixels, so every machine assigns shards alike.
double estimated_cost(const Scene& scene, const RunOptions& options);

}  // namespace drape
