#pragma once

#include <filesystem>
#include <string>

#include "figures/result_table.hpp"
#include "html/chart.hpp"

namespace drape {

struct NamedChart {
  std::string name;  ///< of its files
  html::Chart chart;
};

/// The points of a chart, with where they spread if one of them does.
/// @param every of each series' points the table has one in so many, and the last
ResultTable points_table(const NamedChart& chart, std::size_t every = 1);

/// Writes NAME.svg into the folder, and from it NAME.pdf for LaTeX and NAME.png for word processors, of twice as many
/// pixels each way.
/// @returns what could not be done, as a sentence: what is missing; empty if all is there
/// @throws OutputError if a file cannot be written
std::string write_diagram(const html::Diagram& diagram, const std::filesystem::path& folder, const std::string& name);

/// The same of a chart, with its points as CSV, and as Markdown and LaTeX, which have fewer of very many.
std::string write_chart(const NamedChart& chart, const std::filesystem::path& folder);

}  // namespace drape
