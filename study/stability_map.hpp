#pragma once

#include <string>

#include "reports/diagram.hpp"
#include "reports/result_table.hpp"
#include "study/stability.hpp"

namespace drape {

/// Returns a map's title: "liu13: step length and stiffness of the springs".
std::string map_title(const StabilityMap& map);
/// Returns the base name of its files: "liu13-springs".
std::string map_name(const StabilityMap& map);

/// Draws a map: one square per cell, coloured by energy error. A ring marks unconverged steps, a cross a blow-up, a
/// line the predicted limit.
html::Diagram map_diagram(const StabilityMap& map);

/// Returns the map for a page on which all maps share a legend.
html::Markup map_figure(const StabilityMap& map);
/// Returns the legend of all maps: colours and signs.
html::Markup map_legend();

/// Returns the map as a table for print: a row per stiffness, a column per step.
ResultTable map_table(const StabilityMap& map);

/// Returns CSV: step,stiffness,outcome,energy_error,steps_not_converged,predicted_limit
std::string map_csv(const StabilityMap& map);

}  // namespace drape
