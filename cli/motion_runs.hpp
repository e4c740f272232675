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

/// A scene to simulate, or a motion to draw: by the file's extension, or because the scene names a motion.
/// @param overrides, look as of open_motion()
/// @throws UsageError also if it is a motion that is not complete
SceneToRun open_scene(const std::string& file, const std::vector<std::string>& overrides, const std::string& look = {});

/// Each of the files as open_scene() has it.
/// @throws UsageError with the problems of all of them
std::vector<SceneToRun> open_scenes(const std::vector<std::string>& files, const std::vector<std::string>& overrides);

/// Says where a film shows what its motion's file does not hold.
void warn_of_gaps(const std::string& file, const MotionReader& motion, const FilmExtent& extent);

/// A motion's name, of that or of the file that grows.
/// @throws UsageError if it is neither
std::string motion_to_resume(std::string file);

/// Where a run that ended early goes on.
struct RunToGoOn {
  std::shared_ptr<const Scene> scene;
  RunOptions options;
  Scene drawn;  ///< how the motion is drawn when it is complete
};

/// @param file the motion's
/// @param overrides, look as of open_motion(), for what is drawn of it
/// @returns nothing if it is complete
/// @throws UsageError if there is nothing to go on from
std::optional<RunToGoOn> find_run_to_go_on(const std::string& file, const std::vector<std::string>& overrides,
                                           const std::string& look);

/// "N", "0.1s", or "frames": nothing.
/// @param step of the scene [s]
/// @throws UsageError if it is none of them
RecordedSteps parse_every(const std::string& text, double step);

/// @throws UsageError if a motion of so many steps has fewer than asked for
void require_steps(const std::string& file, std::int64_t last_step, const std::optional<std::int64_t>& steps);

/// Sets what a run of a recorded motion has of it.
/// @throws UsageError as require_steps(), or if what only a simulation has is asked for
void limit_to_motion(const std::string& file, std::int64_t last_step, RunOptions& options);

}  // namespace drape
