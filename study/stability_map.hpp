#pragma once

#include <string>

#include "figures/result_table.hpp"
#include "html/diagram.hpp"
#include "study/stability.hpp"

namespace drape {

/// What a map shows, in a sentence: "liu13: step length and stiffness of the springs".
std::string map_title(const StabilityMap& map);
/// The name of its files: "liu13-springs".
std::string map_name(const StabilityMap& map);

/// A map: a square for every cell, in the colour of its energy error, with a ring where steps did not converge and a
/// cross where it blew up, and the predicted limit as a line.
html::Diagram map_diagram(const StabilityMap& map);

/// The same on a page, where the maps share a legend.
html::Markup map_figure(const StabilityMap& map);
/// The colours and signs of all maps.
html::Markup map_legend();

/// The same as a table for a text: a row for each stiffness, a column for each step.
ResultTable map_table(const StabilityMap& map);

/// step,stiffness,outcome,energy_error,steps_not_converged,predicted_limit
std::string map_csv(const StabilityMap& map);

}  // namespace drape
