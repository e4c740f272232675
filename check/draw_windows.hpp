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

/// Draws states of a scene's motion as its film would show them. Make and use it on one thread.
class DrawWindows {
 public:
  /// @throws UsageError, OutputError as Renderer
  DrawWindows(const Scene& scene, const Eigen::Vector2i& size, const View& view, GlBackend backend);

  /// What draws.
  [[nodiscard]] std::string renderer() const { return renderer_.description(); }

  /// One picture.
  Image draw(int frame, double time, const Vertices& positions);

  /// A picture of each window that has a frame; fewer if it is stopped.
  std::vector<Png> draw(const std::vector<GoldenWindow>& windows, const std::stop_token& stop, Progress& progress);

  /// Draws `shown`, the windows of a plan, and compares each picture with the golden one of that frame.
  /// @param folder of the golden
  /// @returns a result for each window with a frame; fewer if it is stopped
  /// @throws UsageError if a golden picture is missing or damaged
  std::vector<FrameResult> compare(const std::vector<GoldenWindow>& golden, const std::vector<GoldenWindow>& shown,
                                   const std::filesystem::path& folder, const PictureLimits& limits,
                                   const std::stop_token& stop, Progress& progress);

 private:
  Simulation simulation_;  // for the places of what the cloth can touch
  Renderer renderer_;
};

}  // namespace drape
