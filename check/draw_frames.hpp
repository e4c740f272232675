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

/// Draws moments of a scene's motion as its film would show them. Make and use it on one thread.
class DrawFrames {
 public:
  /// @throws UsageError, OutputError as Renderer
  DrawFrames(const Scene& scene, const Eigen::Vector2i& size, GlBackend backend);

  /// What draws.
  [[nodiscard]] std::string renderer() const { return renderer_.description(); }

  /// One picture, from where the camera is then.
  Image draw(const View& view, int frame, double time, const Vertices& positions);

  /// A picture of each frame; fewer if it is stopped.
  std::vector<Png> draw(const std::vector<GoldenFrame>& frames, const std::stop_token& stop, Progress& progress);

  /// Draws frames, and compares each with the golden picture of that frame.
  /// @param frames as the golden has them, or as the motion gives them now, each with the hash of its golden picture
  /// @param folder of the golden
  /// @returns a result for each frame; fewer if it is stopped
  /// @throws UsageError if a golden picture is missing or not as it was recorded
  std::vector<FrameResult> compare(const std::vector<GoldenFrame>& frames, const std::filesystem::path& folder,
                                   const CheckSettings& settings, const std::stop_token& stop, Progress& progress);

 private:
  Simulation simulation_;  // for the places of what the cloth can touch
  Renderer renderer_;
};

}  // namespace drape
