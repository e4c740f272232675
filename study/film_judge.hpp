#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/camera_path.hpp"
#include "render/renderer.hpp"
#include "scene/scene.hpp"
#include "study/step_reference.hpp"

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

}  // namespace drape
