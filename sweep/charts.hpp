#pragma once

#include <string>
#include <vector>

#include "figures/diagram_files.hpp"
#include "html/explore.hpp"
#include "sweep/results.hpp"

namespace drape {

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

/// Returns these diagrams as choices for a page that shows one at a time.
html::Choices choices_of(const SweepDiagrams& diagrams);

}  // namespace drape
