#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/camera_path.hpp"
#include "render/renderer.hpp"
#include "scene/scene.hpp"
#include "study/step_reference.hpp"

namespace drape {

/// The steps after which a film of a scene has its frames: about ten a second, from the start to the last step.
std::vector<std::int64_t> film_steps(const Scene& scene, std::int64_t last);

/// How different a motion looks from the reference motion: FLIP errors (see flip_error) of small pictures, drawn as the
/// scene's film is, by the camera of the reference. Make and use it on one thread.
class FilmJudge {
 public:
  /// @param steps     of the frames, moments of the reference or the start
  /// @param reference which it refers to
  /// @throws UsageError, OutputError as Renderer
  FilmJudge(const Scene& scene, const std::vector<std::int64_t>& steps, const StepReference& reference,
            GlBackend backend);

  /// How many frames are compared: all but that of the start.
  [[nodiscard]] std::size_t count() const { return pictures_.size(); }
  /// The mean over the picture's pixels, 0 (the same) to 1; nothing if there is no frame after that step.
  std::optional<double> error(std::int64_t step, const Vertices& x);
  /// The mean error of the reference's own film before it is extrapolated.
  [[nodiscard]] double unknown() const { return unknown_; }

 private:
  Image draw(std::size_t frame, const Vertices& x);

  double step_;
  Simulation simulation_;  // for the places of what the cloth can touch
  Renderer renderer_;
  std::vector<std::int64_t> steps_;
  std::vector<View> views_;
  std::vector<Image> pictures_;
  double unknown_ = 0;
};

}  // namespace drape
