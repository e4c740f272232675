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

/// Options of a comparison.
struct CompareOptions {
  /// Motion file of each scene; null: the scene is simulated. Empty: all are simulated.
  std::vector<std::shared_ptr<MotionReader>> recorded;
  std::vector<std::string> outputs;  ///< films, pictures and sheets as for a run; .html: a page
  int columns = 0, rows = 0;         ///< size of the grid of panels; 0: automatic
  bool difference = false;           ///< colour each cloth by its distance to the first
  std::optional<double> limit = {};  ///< distance of the last colour [m]; absent: automatic
  std::optional<SheetGrid> sheet;    ///< frames in a .png whose path lacks {frame}; absent: the last
  std::optional<std::int64_t> steps;
  std::optional<FrameRange> frames;
  std::optional<FileLimit> largest_file;  ///< size limit of a film, see SizeLimitedEncoder
  GlBackend backend = GlBackend::automatic;
  std::string command;  ///< the user's command, for the page
};

/// The result for one of the motions.
struct ComparedMotion {
  std::string label;
  Statistics statistics;
  std::string divergence;                         ///< empty unless it diverged
  std::vector<double> total_energy;               ///< total energy per frame [J]
  std::vector<std::optional<double>> most, mean;  ///< vertex distances to the first motion, per frame [m]
  std::string method = {};                        ///< "liu13", "implicit-sdirk2"
  std::string matched = {};                       ///< matching of its vertices, see VertexMatch::note
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
};

/// Returns the times of the i-th motion in a comparison: those of the first scene's film.
/// @throws UsageError as FilmExtent
FilmExtent compared_extent(const std::vector<Scene>& scenes, const CompareOptions& options, std::size_t i);

/// Returns the known properties of a comparison's film; frame rate and size are the first scene's.
/// @throws UsageError as FilmExtent, and if the grid is too small
FilmInfo comparison_info(const std::vector<Scene>& scenes, const CompareOptions& options);

/// Checks that scenes can be compared and that all outputs can be opened.
/// @throws Error as compare_scenes() would
void require_comparison(const std::vector<Scene>& scenes, const CompareOptions& options);

/// Draws the motions of scenes side by side, as SynchronisedMotions plays them. All use the first scene's camera, which
/// has every motion in view.
/// @param scenes at least two
CompareResult compare_scenes(const std::vector<Scene>& scenes, const CompareOptions& options,
                             const std::stop_token& stop, Progress& progress);

}  // namespace drape
