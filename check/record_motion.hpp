#pragma once

#include <stop_token>

#include "check/golden.hpp"
#include "run/progress.hpp"
#include "scene/scene.hpp"

namespace drape {

/// A piece of a scene's motion that is to be recorded.
struct WindowPlan {
  std::optional<int> frame;          ///< the compared frame; absent: none, the start of the motion
  double time = 0;                   ///< of the frame [s]
  std::int64_t first = 0, last = 0;  ///< steps
};

/// Which frames of a scene's film are compared, and which steps of its motion: settings.window steps from each of the
/// frames on, as far as the motion goes, and as many from its start.
/// @throws UsageError if the film has no such frame
std::vector<WindowPlan> plan_windows(const Scene& scene, const CheckSettings& settings);

/// Runs a scene's motion, as far as the plan needs it or as the camera has to see it, and keeps the windows of the
/// plan.
/// @returns all of a golden but its pictures, its date and its machine
/// @throws DivergedError
/// @returns nothing if it was stopped
std::optional<Golden> record_motion(const Scene& scene, const CheckSettings& settings,
                                    const std::vector<WindowPlan>& plan, const std::stop_token& stop,
                                    Progress& progress);

/// The size of a scene's golden pictures [pixels].
Eigen::Vector2i picture_size(const Scene& scene, const CheckSettings& settings);

/// Where the camera would stand if the windows' starts were the whole motion: the same as long as neither the camera,
/// nor what there is to see, nor the way in which the camera is placed changes.
View view_of_windows(const Camera& camera, const Eigen::Vector2i& size, const std::vector<GoldenWindow>& windows,
                     const Simulation& simulation);

}  // namespace drape
