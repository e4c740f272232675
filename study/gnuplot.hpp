#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "html/chart.hpp"

namespace drape {

/// Writes a diagram into a folder: NAME.csv, its points; NAME.gp, which makes gnuplot draw them; and with gnuplot
/// NAME.svg and NAME.png.
/// @returns what could not be done, as a sentence: that gnuplot is missing; empty if all is there
/// @throws OutputError if a file cannot be written
std::string write_plot(const html::Chart& chart, const std::filesystem::path& folder, const std::string& name);

/// Lets gnuplot run a folder's NAME.gp.
/// @returns what could not be done, as a sentence; empty if it was
std::string draw_with_gnuplot(const std::filesystem::path& folder, const std::string& name);

}  // namespace drape
