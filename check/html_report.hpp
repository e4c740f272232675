#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "check/report.hpp"
#include "reports/components.hpp"
#include "reports/diagram_files.hpp"

namespace drape {

/// Returns the diagrams of a comparison, if it has data: the deviation of the motion ("motion"), and the differences of
/// the pictures ("pictures").
std::vector<NamedChart> scene_charts(const SceneResult& scene, const Comparison& comparison);

/// Writes the diagrams of every scene with their points into the scene's folder beside the report, see write_chart().
/// Diagrams of the whole motion are named "end_to_end.motion" and "end_to_end.pictures".
/// @returns the first problem as a sentence; empty if everything was written
/// @throws OutputError if a file cannot be written
std::string write_diagrams(const CheckReport& report, const std::filesystem::path& folder, FigureStyle style);

// Parts of the HTML report for one scene:

html::Tone tone_of(SceneVerdict verdict);
html::Tone tone_of(MotionVerdict verdict);
html::Tone tone_of(PictureVerdict verdict);

/// Returns the verdict as a word with its sign.
template <class Verdict>
html::Markup verdict_badge(Verdict verdict) {
  return html::badge(verdict_name(verdict), tone_of(verdict));
}

/// Returns the largest deviation of any vertex at any step [m]; 0 if there is none.
double largest_deviation(const Comparison& comparison);

/// Returns the largest FLIP error of any pixel in any frame.
double largest_flip(const Comparison& comparison);

/// Returns the whole section of a scene except its name and verdict.
/// @param id unique in the page, for the viewers
html::Markup scene_content(const SceneResult& scene, const std::string& id);

/// Returns the report as one self-contained HTML page: verdicts on top, then the scenes, failed ones first. Each scene
/// has its compared pictures, curves, and the commands to rerun and bless it.
std::string html_report(const CheckReport& report);

/// Writes html_report() to a file.
/// @throws OutputError if the file cannot be written
void write_html_report(const CheckReport& report, const std::filesystem::path& file);

}  // namespace drape
