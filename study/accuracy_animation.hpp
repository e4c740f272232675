#pragma once

#include "render/backend.hpp"
#include "study/accuracy.hpp"
#include "study/report.hpp"

namespace drape {

/// What the panels of an animation differ in.
enum class AnimatedBy { tolerances, methods, steps };
inline constexpr std::array<const char*, 3> animated_by_names{"tolerances", "methods", "steps"};

/// Makes an animation of a scene that was studied: up to four tolerances of one method, the methods at one tolerance,
/// or up to four time steps of one method.
/// @param folder of the results
/// @returns nothing if it was stopped, or there are not two panels
/// @throws OutputError
std::optional<StudyPicture> animate_accuracy(const SceneAccuracy& accuracy, AnimatedBy by,
                                             const std::filesystem::path& folder, GlBackend backend,
                                             const std::stop_token& stop, Progress& progress);

}  // namespace drape
