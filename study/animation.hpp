#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "render/backend.hpp"
#include "run/progress.hpp"
#include "study/study_motion.hpp"

namespace drape {

/// A motion in an animation, and what stands above it.
struct AnimationPanel {
  StudyCase what;
  std::string label;  ///< "liu13, tolerance 0.001: 190 µs per step"
};

/// The bytes of a GIF, and of a PNG that shows some of its moments in rows; and two of its motions to turn.
struct Animation {
  std::string gif, stills;
  html::PlayedMotion reference = {}, worst = {};
  std::size_t worst_panel = 0;  ///< which ends furthest from the reference
};

/// A GIF in which several motions of a scene run side by side, each vertex in the colour of its distance to a reference
/// motion, with a colour bar. Above each panel stands what it is, and its error and flipped pairs at the moment.
/// @param scene     what gives the camera, the size and the duration
/// @param reference settings of the reference motion, see to_rounding()
/// @param panels    cases whose scenes have the same cloth; their steps are not asked
/// @param file      where it is written; its stills, with the extension .png
/// @returns the file's bytes and its stills; nothing if it was stopped
/// @throws OutputError where nothing can be drawn or written, or there is no font; DivergedError
std::optional<Animation> animate_errors(const Scene& scene, const SimulationSettings& reference,
                                        const std::vector<AnimationPanel>& panels, const std::filesystem::path& file,
                                        GlBackend backend, const std::stop_token& stop, Progress& progress);

}  // namespace drape
