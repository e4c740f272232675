#pragma once

#include <string>
#include <vector>

#include "check/golden.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Why a scene's motion is another one than the golden before any step of it is compared; empty if it may be the same.
std::string motion_mismatch(const Scene& scene, const Golden& golden);

/// Why a scene's pictures cannot be compared with the golden ones; empty if they can.
/// @param some_frames only some of the golden frames are compared
std::string picture_mismatch(const Scene& scene, const CheckSettings& settings, const Golden& golden, bool some_frames);

/// Sentences about settings of the film that differ from the golden ones: "the film plays at half the speed". None for
/// a golden that was recorded without them.
std::vector<std::string> film_mismatch(const Scene& scene, const CheckSettings& settings, const Golden& golden);

/// Whether the views of two lists are the same but for rounding, which may differ between processors.
bool same_but_for_rounding(const std::vector<View>& a, const std::vector<View>& b);

}  // namespace drape
