#pragma once

#include "html/explore.hpp"
#include "sweep/results.hpp"

namespace drape {

/// What a figure is called on pages: "µs a step"; its own name where it has no other.
std::string figure_title(const std::string& name);

/// A diagram of each figure that is not the same in all runs over each axis, of which one is chosen. A line for each
/// combination of the other axes; where that would be too many, one for each value of the axis with the fewest, through
/// the medians over the rest.
html::Choices figure_diagrams(const SweepResults& results);

}  // namespace drape
