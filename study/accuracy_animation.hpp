#pragma once

#include "render/backend.hpp"
#include "study/accuracy.hpp"
#include "study/report.hpp"

namespace drape {

/// The property in which the panels of an animation differ.
enum class AnimatedBy { tolerances, methods, steps };
inline constexpr std::array<const char*, 3> animated_by_names{"tolerances", "methods", "steps"};

/// Animates a studied scene: up to four tolerances of one method, the methods at one tolerance, or up to four time
/// steps of one method.
/// @param folder for the results
/// @returns nothing if stopped, or with fewer than two panels
/// @throws OutputError
std::optional<StudyPicture> animate_accuracy(const SceneAccuracy& accuracy, AnimatedBy by,
                                             const std::filesystem::path& folder, GlBackend backend,
                                             const std::stop_token& stop, Progress& progress);

}  // namespace drape
