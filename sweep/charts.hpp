#pragma once

#include <string>
#include <vector>

#include "figures/diagram_files.hpp"
#include "html/explore.hpp"
#include "sweep/results.hpp"

namespace drape {

/// Where the files of diagrams are within a sweep's folder.
inline constexpr const char* diagrams_place = "diagrams";

/// What a figure is called on pages: "µs per step"; its own name where it has no other.
std::string figure_title(const std::string& name);

/// Diagrams of figures over axes.
struct SweepDiagrams {
  std::vector<std::string> figures, axes;
  std::vector<NamedChart> charts;  ///< of each figure over each axis, the axes of a figure together
};

/// A diagram of each figure that is not the same in all runs over each axis. A line for each combination of the other
/// axes; where that would be too many, one for each value of the axis with the fewest, through the medians over the
/// rest.
SweepDiagrams figure_diagrams(const SweepResults& results);

/// Those of which a page shows one that is chosen.
html::Choices choices_of(const SweepDiagrams& diagrams);

}  // namespace drape
