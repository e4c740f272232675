#pragma once

#include <filesystem>
#include <string>

#include "figures/result_table.hpp"
#include "html/chart.hpp"

namespace drape {

struct NamedChart {
  std::string name;  ///< name of its files, without ending
  html::Chart chart;
};

/// Returns the points of a chart as a table, with their spread if given.
/// @param every stride of the points in each series; the last is always included
ResultTable points_table(const NamedChart& chart, std::size_t every = 1);

/// Writes NAME.svg into the folder, and from it NAME.pdf for LaTeX and NAME.png, of twice the size, for word
/// processors.
/// @returns a sentence about missing software if the PDF and PNG cannot be made; otherwise empty
/// @throws OutputError if a file cannot be written
std::string write_diagram(const html::Diagram& diagram, const std::filesystem::path& folder, const std::string& name);

/// Writes the diagram of a chart, and its points as CSV, Markdown and LaTeX; the latter two thin out long tables.
std::string write_chart(const NamedChart& chart, const std::filesystem::path& folder);

}  // namespace drape
