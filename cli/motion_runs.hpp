#pragma once

#include <string>
#include <vector>

#include "run/run_scene.hpp"

namespace drape {

/// Returns true for a motion file, by its extension.
bool is_motion_file(const std::string& file);

/// A scene to run, with its motion if recorded.
struct SceneToRun {
  LoadedScene scene;
  std::shared_ptr<MotionReader> recorded;  ///< also keeps the scene's files
};

/// Opens a motion for drawing.
/// @param overrides overrides of its scene, or of `look`
/// @param look      another scene that provides camera, look and film; empty: its own
/// @throws UsageError if the motion is damaged, or the physics of the scene differs
SceneToRun open_motion(const std::string& file, const std::vector<std::string>& overrides, const std::string& look);

/// Opens a scene to simulate or a motion to draw, by the file's extension or a motion that the scene names.
/// @param overrides, look as in open_motion()
/// @throws UsageError also for an incomplete motion
SceneToRun open_scene(const std::string& file, const std::vector<std::string>& overrides, const std::string& look = {});

/// Opens all files as open_scene() does.
/// @throws UsageError with all problems
std::vector<SceneToRun> open_scenes(const std::vector<std::string>& files, const std::vector<std::string>& overrides);

/// Warns about film frames between stored states of the motion.
void warn_of_gaps(const std::string& file, const MotionReader& motion, const FilmExtent& extent);

/// Returns the name of a motion from its own name or that of its growing file.
/// @throws UsageError for other names
std::string motion_to_resume(std::string file);

/// A run to resume.
struct ResumableRun {
  std::shared_ptr<const LoadedScene> scene;
  RunOptions options;
  LoadedScene drawn;  ///< scene for drawing the complete motion
};

/// @param file the motion to resume
/// @param overrides, look as in open_motion(), for drawing
/// @returns nothing if the motion is complete
/// @throws UsageError if it cannot be resumed
std::optional<ResumableRun> find_resumable_run(const std::string& file, const std::vector<std::string>& overrides,
                                               const std::string& look);

/// Parses "N", "0.1s", or "frames" (no interval).
/// @param step step of the scene [s]
/// @throws UsageError for other texts
RecordedSteps parse_every(const std::string& text, double step);

/// @throws UsageError if more steps are requested than the motion has
void require_steps(const std::string& file, std::int64_t last_step, const std::optional<std::int64_t>& steps);

/// Restricts the options of a run to a recorded motion.
/// @throws UsageError as require_steps(), or for options that need a simulation
void limit_to_motion(const std::string& file, std::int64_t last_step, RunOptions& options);

}  // namespace drape
