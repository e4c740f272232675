#pragma once

#include <filesystem>

#include "reports/diagram_files.hpp"

namespace drape {

/// Returns the points of a chart as a table of numbers for pgfplots: columns x0 and y0 for the first series, x1 and y1
/// for the second, and so on. "nan" fills short columns and marks gaps.
std::string pgfplots_data(const html::Chart& chart);

/// Returns the chart as a tikzpicture for \input, which reads NAME.dat.
/// @param inches width
std::string pgfplots_picture(const NamedChart& chart, double inches);

/// Writes NAME.dat and NAME.tikz.tex. @throws OutputError
void write_pgfplots(const NamedChart& chart, const std::filesystem::path& folder, double inches);

}  // namespace drape
