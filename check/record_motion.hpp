#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "check/choose_frames.hpp"
#include "check/golden.hpp"
#include "check/played_motion.hpp"
#include "run/progress.hpp"
#include "scene/scene.hpp"

namespace drape {

/// How a scene's motion is to be recorded.
struct RecordPlan {
  std::vector<ChosenFrame> frames;  ///< whose pictures are compared, ascending
  std::int64_t window_steps = 1;
  Quanta quanta;
};

/// As the scene's table [check] says. Without frames in it, those in which something happens are chosen, for which the
/// motion is run.
/// @param recorded the motion, which is read then; null: the scene is simulated
/// @throws UsageError if the film has no such frame; DivergedError
/// @returns nothing if it was stopped
std::optional<RecordPlan> plan_recording(const Scene& scene, const CheckSettings& settings, const std::stop_token& stop,
                                         Progress& progress, PlayedMotion* recorded = nullptr);

/// The plan by which a golden was recorded.
RecordPlan plan_of(const Golden& golden);

/// Runs a scene's motion, or reads the one that was recorded, and places the camera.
/// @returns all of a golden but its pictures, its date and its machine; nothing if it was stopped
/// @throws DivergedError
std::optional<Golden> record_motion(const Scene& scene, const CheckSettings& settings, const RecordPlan& plan,
                                    const std::stop_token& stop, Progress& progress, PlayedMotion* recorded = nullptr);

/// Settings of a scene's film that its golden keeps.
GoldenFilm film_of(const Scene& scene);

/// The size of a scene's golden pictures [pixels].
Eigen::Vector2i picture_size(const Scene& scene, const CheckSettings& settings);

/// Where the camera would stand if the compared frames were the whole motion: the same as long as neither the camera,
/// nor what there is to see, nor the way in which the camera is placed changes.
/// @returns the view in each of them
std::vector<View> views_of_frames(const Scene& scene, const Eigen::Vector2i& size,
                                  const std::vector<GoldenFrame>& frames);

}  // namespace drape
