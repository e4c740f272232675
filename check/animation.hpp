#pragma once

#include <filesystem>
#include <string>

#include "check/golden.hpp"
#include "check/played_motion.hpp"
#include "check/report.hpp"
#include "html/motion_player.hpp"
#include "render/backend.hpp"
#include "scene/scene.hpp"

namespace drape {

/// The bytes of a GIF, and of a PNG that shows some of its moments below one another; both empty: there is nothing.
struct DifferenceAnimation {
  std::string gif, stills;
  html::PlayedMotion expected, actual;  ///< of a changed motion, to turn
};

/// A GIF that shows expected, actual and difference side by side and repeats: of a changed motion the steps of the
/// first windows that changed whose positions are compared, drawn alike, else the compared frames around the first
/// picture that changed.
/// @param folder  where it is written, as NAME/difference.gif
/// @throws OutputError
DifferenceAnimation difference_animation(const Scene& scene, const Golden& golden, const SceneResult& result,
                                         PlayedMotion* recorded, GlBackend backend,
                                         const std::filesystem::path& folder);

}  // namespace drape
