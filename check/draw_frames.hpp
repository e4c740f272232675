#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "check/golden.hpp"
#include "check/report.hpp"
#include "render/backend.hpp"
#include "render/renderer.hpp"
#include "run/progress.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Renderer of moments of a scene's motion, as in its film. Create and use it on one thread.
class DrawFrames {
 public:
  /// @throws UsageError, OutputError as Renderer
  DrawFrames(const Scene& scene, const Eigen::Vector2i& size, GlBackend backend);

  /// Returns a description of the renderer.
  [[nodiscard]] std::string renderer() const { return renderer_.description(); }

  /// Draws one picture.
  Image draw(const View& view, int frame, double time, const Vertices& positions);

  /// Draws a picture of each frame; fewer if stopped.
  std::vector<Png> draw(const std::vector<GoldenFrame>& frames, const std::stop_token& stop, Progress& progress);

  /// Draws frames and compares each with its golden picture.
  /// @param frames of the golden or of a new motion, each with the hash of its golden picture
  /// @param folder of the golden
  /// @returns a result for each frame; fewer if stopped
  /// @throws UsageError if a golden picture is missing or modified
  std::vector<FrameResult> compare(const std::vector<GoldenFrame>& frames, const std::filesystem::path& folder,
                                   const CheckSettings& settings, const std::stop_token& stop, Progress& progress);

 private:
  Simulation simulation_;  // gives the positions of colliders
  Renderer renderer_;
};

}  // namespace drape
