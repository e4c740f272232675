#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "compare/differences.hpp"
#include "html/motion_player.hpp"
#include "output/format.hpp"
#include "render/backend.hpp"
#include "run/progress.hpp"
#include "run/run_scene.hpp"
#include "scene/scene.hpp"

namespace drape {

/// How scenes are compared.
struct CompareOptions {
  /// By scene: its motion, where that is in a file and need not be computed. Empty: none is.
  std::vector<std::shared_ptr<MotionReader>> recorded;
  std::vector<std::string> outputs;  ///< films, pictures and sheets as of a run; .html: a page
  int columns = 0, rows = 0;         ///< of the grid of panels; 0: what suits their number
  bool difference = false;           ///< colour each by its distance to the first
  std::optional<SheetGrid> sheet;    ///< what a .png without {frame} holds instead of the last picture
  std::optional<std::int64_t> steps;
  std::optional<FrameRange> frames;
  std::optional<FileLimit> largest_file;  ///< that a film may become, see FittedFilm
  GlBackend backend = GlBackend::automatic;
  std::string command;  ///< that asked for it, for the page
};

/// What became of one of the motions.
struct ComparedMotion {
  std::string label;
  Statistics statistics;
  std::string divergence;                         ///< empty unless it diverged
  std::vector<double> total_energy;               ///< by frame [J]
  std::vector<std::optional<double>> most, mean;  ///< of the vertices' distances to the first, by frame [m]
  std::string method = {};                        ///< "liu13", "implicit-sdirk2"
  std::string matched = {};                       ///< how its vertices are compared, see VertexMatch::note
  html::PlayedMotion played = {};                 ///< to turn on a page; without frames where there is none
};

struct CompareResult {
  bool interrupted = false;
  std::vector<ComparedMotion> motions;
  std::vector<KeyDifference> differences;
  std::vector<double> times;  ///< of the frames [s]
  int frames_wanted = 0;
  std::vector<std::vector<OutputFile>> outputs;  ///< the files of each output that there is
  std::vector<std::string> problems;             ///< a message for each that could not be written
  std::string missing;  ///< what of the page's diagrams could not be made, as a sentence; empty: nothing
};

/// The moments of the i-th motion that a comparison shows: those of the first scene's film.
/// @throws UsageError as FilmExtent
FilmExtent compared_extent(const std::vector<Scene>& scenes, const CompareOptions& options, std::size_t i);

/// What is known of the film of a comparison before its first frame: the clock and the size are the first scene's.
/// @throws UsageError as FilmExtent, and if the grid is too small
FilmInfo comparison_info(const std::vector<Scene>& scenes, const CompareOptions& options);

/// Looks whether scenes can be compared, and opens everything that would be written.
/// @throws Error what compare_scenes() would end with
void require_comparison(const std::vector<Scene>& scenes, const CompareOptions& options);

/// Draws the motions of scenes side by side, as MotionsInStep plays them, from one camera that has all of them in view,
/// the first scene's.
/// @param scenes at least two
CompareResult compare_scenes(const std::vector<Scene>& scenes, const CompareOptions& options,
                             const std::stop_token& stop, Progress& progress);

}  // namespace drape
