#pragma once

#include "run/run_scene.hpp"
#include "scene/scene.hpp"

namespace drape {

/// How long a run of a scene takes on a processor as they were in 2022 [s], within a factor of about three: from its
/// method, its effects and the numbers of steps, springs, vertices and pixels alone, so that every machine shares out
/// work alike.
double estimated_cost(const Scene& scene, const RunOptions& options);

}  // namespace drape
