#pragma once

#include <string>
#include <vector>

#include "run/run_scene.hpp"

namespace drape {

/// Whether a file is a motion, by its extension.
bool is_motion_file(const std::string& file);

/// What is to be run: a scene, and its motion where that is in a file.
struct SceneToRun {
  Scene scene;
  std::shared_ptr<MotionReader> recorded;  ///< keeps the scene's files, too
};

/// A motion to draw.
/// @param overrides of its scene, or of the other one
/// @param look      another scene whose camera, look and film are taken; empty: its own
/// @throws UsageError if the motion is damaged, or the scene would move otherwise
SceneToRun open_motion(const std::string& file, const std::vector<std::string>& overrides, const std::string& look);

/// Where a run that ended early goes on.
struct RunToGoOn {
  std::shared_ptr<const Scene> scene;
  RunOptions options;
};

/// @param file the motion's, or the one that grows
/// @returns nothing if it is complete
/// @throws UsageError if there is nothing to go on from
std::optional<RunToGoOn> find_run_to_go_on(std::string file);

/// "N", or "frames": nothing.
/// @throws UsageError if it is neither
RecordedSteps parse_every(const std::string& text);

/// Sets what a run of a recorded motion has of it.
/// @throws UsageError if there are fewer steps than asked for, or what only a simulation has is asked for
void limit_to_motion(const MotionReader& motion, RunOptions& options);

}  // namespace drape
