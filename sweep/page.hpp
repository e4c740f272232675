#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "reports/diagram_files.hpp"
#include "reports/players.hpp"
#include "sweep/plan.hpp"
#include "sweep/results.hpp"

namespace drape {

/// Returns true if a sweep chooses the viewing direction of a scene's films: its camera has no position and lacks an
/// angle. All such films share the direction of the plan's `side` run, for comparison. The camera distance is fitted to
/// each motion.
bool chooses_side(const SweepRequest& request, const Camera& camera);

/// Returns the key of a run whose viewing direction comes from another run.
/// @param key  see run_key()
/// @param side the other run's key; empty or equal to `key`: the run's own direction
std::string key_seen_from(const std::string& key, const std::string& side);

/// Returns the camera, with azimuth and elevation, of the run that decides the viewing direction, see well_placed().
/// Simulates that run. If it fails or is stopped, returns the default direction.
Camera side_of_films(const SweepPlan& plan, const std::stop_token& stop);

/// Fills missing angles of a camera from `side`.
void look_from(const Camera& side, Camera& camera);

/// Subfolder of the diagrams in a sweep's folder.
inline constexpr const char* diagrams_place = "diagrams";

/// Returns a figure's title for pages: "µs per step"; by default its name.
std::string figure_title(const std::string& name);

/// Diagrams of figures over axes.
struct SweepDiagrams {
  std::vector<std::string> figures, axes;
  std::vector<NamedChart> charts;  ///< one chart per figure and axis, grouped by figure
};

/// Plots each figure that varies between runs over each axis, with a line per combination of the other axes. With too
/// many combinations, plots a line per value of the axis with the fewest values, through the medians over the rest.
SweepDiagrams figure_diagrams(const SweepResults& results);

/// Returns diagrams as choices for a page that shows one at a time.
html::Choices choices_of(const SweepDiagrams& diagrams);

/// File name of the page.
inline constexpr const char* sweep_page_name = "report.html";

/// Writes a sweep's reports into its folder: runs.csv, report.md, table.tex, the page, and every diagram as CSV, SVG,
/// PDF and PNG.
/// @returns the first problem as a sentence; empty if everything was written
/// @throws OutputError
std::string write_sweep_report(const SweepResults& results, const std::filesystem::path& folder,
                               FigureStyle style = FigureStyle::screen);

/// Returns a self-contained page: grids of synchronised films, diagrams of figures over axes, and a sortable table of
/// all runs with their figures.
/// @param folder of the sweep, with the contact sheets of films
std::string sweep_page(const SweepResults& results, const std::filesystem::path& folder);

}  // namespace drape
