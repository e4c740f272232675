#pragma once

#include <filesystem>
#include <string>

#include "html/markup.hpp"
#include "study/stability.hpp"

namespace drape {

/// What a map shows, in a sentence: "liu13: step length and stiffness of the springs".
std::string map_title(const StabilityMap& map);
/// The name of its files: "liu13-springs".
std::string map_name(const StabilityMap& map);

/// A map as inline SVG: a square for every cell, in the colour of its energy error, with a ring where steps did not
/// converge and a cross where it blew up, and the predicted limit as a line.
html::Markup map_svg(const StabilityMap& map);
/// The colours and signs of all maps.
html::Markup map_legend();

/// step,stiffness,outcome,energy_error,steps_not_converged,predicted_limit.
std::string map_csv(const StabilityMap& map);

/// Writes NAME.csv, NAME.gp and, with gnuplot, NAME.svg and NAME.png.
/// @returns what could not be done, as a sentence; empty if all is there
/// @throws OutputError
std::string write_map(const StabilityMap& map, const std::filesystem::path& folder);

}  // namespace drape
