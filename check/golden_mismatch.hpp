#pragma once

#include <string>
#include <vector>

#include "check/golden.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Returns a reason why a scene's motion cannot equal the golden one, before any step is compared; empty: none.
std::string motion_mismatch(const Scene& scene, const Golden& golden);

/// Returns a reason why a scene's pictures cannot be compared with the golden ones; empty: none.
/// @param some_frames true if only some of the golden frames are compared
std::string picture_mismatch(const Scene& scene, const CheckSettings& settings, const Golden& golden, bool some_frames);

/// Returns sentences on film settings that differ from the golden ones: "the film plays at half the speed". Empty for a
/// golden without film settings.
std::vector<std::string> film_mismatch(const Scene& scene, const CheckSettings& settings, const Golden& golden);

/// Returns true if two lists of views are equal except for rounding, which may differ between processors.
bool same_but_for_rounding(const std::vector<View>& a, const std::vector<View>& b);

}  // namespace drape
