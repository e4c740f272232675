#pragma once

#include <stop_token>
#include <string>

#include "sweep/plan.hpp"

namespace drape {

/// Returns true if a sweep chooses the viewing direction of a scene's films: its camera has no position, and not both
/// angles. All these films share the direction of the plan's `side` run, for comparison. The camera distance is fitted
/// to each motion.
bool chooses_side(const SweepRequest& request, const Camera& camera);

/// Returns the key of a run whose viewing direction comes from another run.
/// @param key  see run_key()
/// @param side the other run's key; empty or equal to `key`: the run's own direction
std::string key_seen_from(const std::string& key, const std::string& side);

/// Returns the camera, with azimuth and elevation, of the run that decides the viewing direction, see well_placed().
/// Simulates that run. If it fails or is stopped, returns the default direction.
Camera side_of_films(const SweepPlan& plan, const std::stop_token& stop);

/// Fills missing angles of a camera from `side`.
void look_from(const Camera& side, Camera& camera);

}  // namespace drape
