#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drape/scene/scene.hpp"
#include "run/run_scene.hpp"

namespace drape {

/// Opens a file or an address in its desktop application with xdg-open, without waiting. Warns if there is none.
void open_file(const std::string& what);

/// Collector of the problems of several scenes, each line once. A line about --set or --vary starts with its scene,
/// unless it applies to all of them.
class SceneProblems {
 public:
  /// @param message a line for each problem, as load_scene() throws it
  void add(const std::string& file, std::string_view message);

  /// @param files all scenes
  /// @throws UsageError that lists the problems, if there are any
  void throw_if_any(const std::vector<std::string>& files) const;

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> lines_;  // lines, each with its scenes
};

/// Loads all scenes and reports all of their problems at once.
/// @throws UsageError
std::vector<LoadedScene> load_scenes(const std::vector<std::string>& files, const std::vector<std::string>& overrides);

/// Returns unique names for scenes, valid as file names: their own names, prefixed by the folder if ambiguous.
/// @param taken reserved names
std::vector<std::string> unique_names(const std::vector<LoadedScene>& scenes, const std::set<std::string>& taken = {});

/// Checks that no file is written twice, and that no input is overwritten. Files are compared by identity, not by name.
/// @param options of each scene
/// @throws UsageError that lists all such files
void require_distinct_files(const std::vector<LoadedScene>& scenes, const std::vector<RunOptions>& options);

/// Returns true for a motion file, by its extension.
bool is_motion_file(const std::string& file);

/// A scene to run, with its motion if recorded.
struct SceneToRun {
  LoadedScene scene;
  std::shared_ptr<MotionReader> recorded;  ///< also keeps the scene's files
};

/// Opens a scene to simulate or a motion to draw, by the file's extension or a motion that the scene names.
/// @param overrides overrides of its scene, or of `look`
/// @param look      another scene that provides camera, look and film of a motion; empty: its own
/// @throws UsageError if a motion is damaged or incomplete, its scene's physics differs, or as require_known_values()
SceneToRun open_scene(const std::string& file, const std::vector<std::string>& overrides, const std::string& look = {});

/// Checks that a film of a motion shows only what is known of it: other programs give no energies and no iterations.
/// @throws UsageError
void require_known_values(const std::string& file, const MotionHeader& header, const Scene& drawn);

/// Opens all files as open_scene() does.
/// @throws UsageError with all problems
std::vector<SceneToRun> open_scenes(const std::vector<std::string>& files, const std::vector<std::string>& overrides);

/// Warns about film frames between stored states of the motion.
void warn_of_gaps(const std::string& file, const MotionReader& motion, const FilmExtent& extent);

/// Returns the name of a motion from this name or the name of its growing file.
/// @throws UsageError for other names
std::string motion_to_resume(std::string file);

/// A run to resume.
struct ResumableRun {
  std::shared_ptr<const LoadedScene> scene;
  RunOptions options;
  LoadedScene drawn;  ///< scene for drawing the complete motion
};

/// Finds the run that wrote an incomplete motion.
/// @param file the motion to resume
/// @param overrides, look as in open_scene(), for drawing
/// @returns nothing if the motion is complete
/// @throws UsageError if the motion cannot be resumed
std::optional<ResumableRun> find_resumable_run(const std::string& file, const std::vector<std::string>& overrides,
                                               const std::string& look);

/// Parses "N", "0.1s", or "frames" (no interval).
/// @param step step of the scene [s]
/// @throws UsageError for other texts
RecordedSteps parse_every(const std::string& text, double step);

/// Checks that a motion has the requested steps.
/// @throws UsageError if more steps are requested than the motion has
void require_steps(const std::string& file, std::int64_t last_step, const std::optional<std::int64_t>& steps);

/// Restricts the options of a run to a recorded motion.
/// @throws UsageError as require_steps(), or for options that need a simulation
void limit_to_motion(const std::string& file, std::int64_t last_step, RunOptions& options);

}  // namespace drape
