#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "drape/render/settings.hpp"
#include "drape/scene/scene.hpp"
#include "motion/vertex_order.hpp"
#include "output/registry.hpp"
#include "render/camera_path.hpp"
#include "reports/diagram.hpp"
#include "reports/players.hpp"
#include "run/frame_source.hpp"
#include "run/progress.hpp"
#include "run/run_scene.hpp"

namespace drape {

/// A mapping of a scene's vertices to those of the first scene.
struct VertexMatch {
  bool comparable = true;  ///< both have the same number of vertices
  VertexOrder order;       ///< index in the first scene, by vertex of this scene; empty: equal indices
  std::string note;        ///< end of a sentence that begins with the scene's name, unless indices are equal
};

/// Matches the vertices of each scene with those of the first. Indices are kept if the triangles or the start positions
/// are the same. Otherwise vertices are matched by their start positions, if possible.
std::vector<VertexMatch> match_scenes(const std::vector<LoadedScene>& scenes);

/// A key with different values in some scenes.
struct KeyDifference {
  std::string key;                  ///< "integrator.method"
  std::vector<std::string> values;  ///< values by scene; "–" for a missing key
};

/// Returns the keys that differ, given or by default. Excludes keys that a comparison takes from its first scene:
/// camera, film, caption and overlay.
std::vector<KeyDifference> differences(const std::vector<LoadedScene>& scenes);

/// Returns a label for each scene that tells it from the others: "liu13, tolerance = 0.001". Uses the scenes' names if
/// they differ, or if nothing else does.
std::vector<std::string> labels(const std::vector<LoadedScene>& scenes, const std::vector<KeyDifference>& differences);

/// Options of a comparison.
struct CompareOptions {
  /// Motion file of each scene; null: the scene is simulated. Empty: all are simulated.
  std::vector<std::shared_ptr<MotionReader>> recorded;
  std::vector<std::string> outputs;  ///< films, pictures and sheets as for a run; .html: a page
  int columns = 0, rows = 0;         ///< size of the grid of panels; 0: automatic
  bool difference = false;           ///< colour each cloth by its distance to the first
  std::optional<double> limit = {};  ///< distance at the end of the colour scale [m]; absent: automatic
  std::optional<SheetGrid> sheet;    ///< frames in a .png whose path lacks {frame}; absent: the last
  std::optional<std::int64_t> steps;
  std::optional<FrameRange> frames;
  std::optional<FileLimit> largest_file;  ///< size limit of a film, see SizeLimitedEncoder
  GlBackend backend = GlBackend::automatic;
  std::string command;                      ///< the user's command, for the page
  FigureStyle style = FigureStyle::screen;  ///< style of the page's diagram files
};

/// The result for one of the motions.
struct ComparedMotion {
  std::string label;
  Statistics statistics;
  std::string divergence;                           ///< empty unless it diverged
  std::vector<std::optional<double>> total_energy;  ///< total energy per frame, if known [J]
  std::vector<std::optional<double>> most, mean;    ///< vertex distances to the first motion, per frame [m]
  std::string method = {};                          ///< "liu13", "implicit-sdirk2"
  std::string matched = {};                         ///< matching of its vertices, see VertexMatch::note
  html::PlayedMotion played = {};  ///< motion for interactive viewing on a page; without frames if there is none
};

struct CompareResult {
  bool interrupted = false;
  std::vector<ComparedMotion> motions;
  std::vector<KeyDifference> differences;
  std::vector<double> times;  ///< times of the frames [s]
  int frames_wanted = 0;
  std::vector<std::vector<OutputFile>> outputs;  ///< the files of each completed output
  std::vector<std::string> problems;             ///< a message for each output that could not be written
  std::string missing;                           ///< a sentence on missing diagrams of the page; empty: none missing
  bool keys_known = true;                        ///< false: a motion of another program has no keys to compare
};

/// Returns the frame times of the i-th motion in a comparison, which are those of the first scene's film.
/// @throws UsageError as FilmExtent
FilmExtent compared_extent(const std::vector<LoadedScene>& scenes, const CompareOptions& options, std::size_t i);

/// Returns the known properties of a comparison's film; frame rate and size are the first scene's.
/// @throws UsageError as FilmExtent, and if the grid is too small
FilmInfo comparison_info(const std::vector<LoadedScene>& scenes, const CompareOptions& options);

/// Checks that scenes can be compared and that all outputs can be opened.
/// @throws Error as compare_scenes() would
void require_comparison(const std::vector<LoadedScene>& scenes, const CompareOptions& options);

/// Draws the motions of scenes side by side, as SynchronisedMotions plays them. All use the first scene's camera, which
/// has every motion in view.
/// @param scenes at least two
CompareResult compare_scenes(const std::vector<LoadedScene>& scenes, const CompareOptions& options,
                             const std::stop_token& stop, Progress& progress);

/// Returns the frames of a comparison, up to the end of the longest motion.
FrameRange all_frames(const std::vector<LoadedScene>& scenes, const CompareOptions& options);

/// The motions of a comparison, each at the times of the first scene's film. Each motion is simulated once, for any
/// number of passes, or read from its file. Frames beyond a memory limit are stored in temporary files.
class SynchronisedMotions {
 public:
  /// The current frame of each motion. A motion that has ended or diverged keeps its last frame.
  using Moment = std::vector<const Frame*>;

  /// @param scenes outlive the object
  /// @param often  true if the motions are played more than once, always from start to end
  SynchronisedMotions(const std::vector<LoadedScene>& scenes, const CompareOptions& options, bool often);

  /// Plays all motions from the start; calls work(k, moment) for each frame k up to `last`. Ends early when stopped.
  void play(int last, const std::stop_token& stop, const std::function<void(int, const Moment&)>& work);

  /// Returns the i-th motion, as far as it was played.
  [[nodiscard]] const FrameSource& motion(std::size_t i) const { return sources_[i]; }

  /// Returns the first scene's camera for `count` frames, with all motions in view. Angles that the scene omits are
  /// those of its own film.
  /// @returns nothing if stopped
  std::optional<CameraPath> camera_path(int count, const std::stop_token& stop);

 private:
  const std::vector<LoadedScene>& scenes_;
  int first_count_;  // frames of the first motion's film
  std::deque<FrameSource> sources_;
};

}  // namespace drape
