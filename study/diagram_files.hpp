#pragma once

#include <filesystem>
#include <string>

#include "html/chart.hpp"
#include "study/result_table.hpp"

namespace drape {

struct NamedChart {
  std::string name;  ///< of its files
  html::Chart chart;
};

/// An empty series in its method's colour and sign, which are the same in every diagram. Where the name says more than
/// the method ("liu13, report"), it is dashed and its signs are open.
html::ChartSeries method_series(const std::string& name);

/// The points of a chart, with where they spread if one of them does.
ResultTable points_table(const NamedChart& chart);

/// Writes NAME.svg into the folder, and from it NAME.pdf for LaTeX and NAME.png for word processors, of twice as many
/// pixels each way.
/// @returns what could not be done, as a sentence: what is missing; empty if all is there
/// @throws OutputError if a file cannot be written
std::string write_diagram(const html::Diagram& diagram, const std::filesystem::path& folder, const std::string& name);

/// The same of a chart, with its points as write_table() writes them.
std::string write_chart(const NamedChart& chart, const std::filesystem::path& folder);

}  // namespace drape
