#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "drape/render/renderer.hpp"
#include "drape/render/settings.hpp"
#include "drape/scene/scene.hpp"
#include "output/gif_encoder.hpp"
#include "render/camera_path.hpp"
#include "reports/players.hpp"
#include "run/progress.hpp"
#include "study/reference.hpp"
#include "study/runs_file.hpp"

namespace drape {

/// Returns the steps after which a scene's comparison film has a frame: about ten a second, up to the last step.
std::vector<std::int64_t> film_steps(const Scene& scene, std::int64_t last);

/// Visual difference of a motion from the reference motion: FLIP errors (see flip_error) of small pictures, drawn like
/// the scene's film with the reference's camera. Create and use it on one thread.
class FilmJudge {
 public:
  /// @param steps     of the frames; moments of the reference
  /// @param reference the motion to compare with
  /// @throws UsageError, OutputError as Renderer
  FilmJudge(const Scene& scene, const std::vector<std::int64_t>& steps, const StepReference& reference,
            GlBackend backend);

  /// Returns the number of compared frames: all but the first.
  [[nodiscard]] std::size_t count() const { return pictures_.size(); }
  /// Returns the mean error over the picture's pixels, 0 (equal) to 1; nothing if no frame follows that step.
  std::optional<double> error(std::int64_t step, const Vertices& x);
  /// Returns the mean error of the reference's own film without extrapolation.
  [[nodiscard]] double unknown() const { return unknown_; }

 private:
  Image draw(std::size_t frame, const Vertices& x);

  double step_;
  Simulation simulation_;  // for the positions of colliders
  Renderer renderer_;
  std::vector<std::int64_t> steps_;
  std::vector<View> views_;
  std::vector<Image> pictures_;
  double unknown_ = 0;
};

/// A motion in an animation, with its heading.
struct AnimationPanel {
  StudyCase study_case;
  std::string label;  ///< "liu13, tolerance 0.001: 190 µs per step"
};

/// A film of several motions, and two of them for interactive viewing.
struct Animation {
  PageFilm film;
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
