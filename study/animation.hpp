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

/// A motion in an animation, with its heading.
struct AnimationPanel {
  StudyCase what;
  std::string label;  ///< "liu13, tolerance 0.001: 190 µs per step"
};

/// An animation as GIF, some of its frames in a PNG, and two of its motions for interactive viewing.
struct Animation {
  std::string gif, stills;
  html::PlayedMotion reference = {}, worst = {};
  std::size_t worst_panel = 0;  ///< the panel with the largest error at the end
};

/// Makes a GIF with several motions of a scene side by side. Vertex colours show the distance to a reference motion,
/// with a colour bar. The heading of each panel has its label, current error and number of flipped pairs. The loop
/// begins at the reference's PosterFrame.
/// @param scene     gives the camera, the size and the duration
/// @param reference settings of the reference motion, see to_rounding()
/// @param panels    cases with the scene's cloth; their step counts are ignored
/// @param file      path of the GIF; the stills get the extension .png
/// @returns nothing if stopped
/// @throws OutputError if drawing or writing fails, or no font is found; DivergedError
std::optional<Animation> animate_errors(const Scene& scene, const SimulationSettings& reference,
                                        const std::vector<AnimationPanel>& panels, const std::filesystem::path& file,
                                        GlBackend backend, const std::stop_token& stop, Progress& progress);

}  // namespace drape
