#pragma once

#include <stop_token>
#include <string>

#include "sweep/plan.hpp"

namespace drape {

/// Whether a sweep chooses the side from which a scene is seen: of its films those whose camera is not said to be
/// anywhere. All of them are seen from one side, that of the plan's `side`, so that they can be compared; how near the
/// camera is depends on each motion alone.
bool chooses_side(const SweepRequest& request, const Camera& camera);

/// The key of a run that is seen from the side that suits another run.
/// @param key  see run_key()
/// @param side the other run's key; empty, or the same: it is seen from its own
std::string key_seen_from(const std::string& key, const std::string& side);

/// The camera of the run whose motion says from which side films are seen, with azimuth and elevation, see
/// well_placed(). Simulates it. Without a motion, because it fails or is stopped, it is the usual direction.
Camera side_of_films(const SweepPlan& plan, const std::stop_token& stop);

/// Gives a camera what it does not say of the side from which it looks.
void look_from(const Camera& side, Camera& camera);

}  // namespace drape
