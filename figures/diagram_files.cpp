#include "figures/diagram_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "figures/svg_printer.hpp"

namespace drape {
namespace {

constexpr double png_scale = 2;

/// Returns the shortest text that reads back as the same number.
std::string shortest(double value) { return fmt::format("{}", value); }

/// Returns the stride that keeps a table short enough for a document.
std::size_t sparse(std::size_t rows) { return (rows + most_set_rows - 1) / most_set_rows; }

/// Returns the indices of every `every`-th finite point, including the last.
std::vector<std::size_t> finite_points(const html::ChartSeries& series, std::size_t every) {
  std::vector<std::size_t> finite, chosen;
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    if (std::isfinite(series.points[i].x) && std::isfinite(series.points[i].y)) finite.push_back(i);
  }
  for (std::size_t i = 0; i < finite.size(); ++i) {
    if (i % every == 0 || i + 1 == finite.size()) chosen.push_back(finite[i]);
  }
  return chosen;
}

}  // namespace

ResultTable points_table(const NamedChart& named, std::size_t every) {
  const html::Chart& chart = named.chart;
  const bool spread = std::ranges::any_of(chart.series, [](const html::ChartSeries& series) {
    return std::ranges::any_of(series.points, [](const html::ChartPoint& p) { return p.spread.has_value(); });
  });
  const bool unnamed = chart.series.size() == 1 && chart.series.front().name.empty();
  ResultTable table{named.name, chart.title, {chart.x_title, chart.y_title}, {}, {}};
  if (!unnamed) table.columns.insert(table.columns.begin(), "series");
  if (spread) table.columns.insert(table.columns.end(), {"from", "to"});
  for (const html::ChartSeries& series : chart.series) {
    for (const std::size_t i : finite_points(series, every)) {
      const html::ChartPoint& point = series.points[i];
      std::vector<std::string> cells{shortest(point.x), shortest(point.y)};
      if (!unnamed) cells.insert(cells.begin(), series.name);
      for (const std::size_t end : {0U, 1U}) {
        if (spread) cells.push_back(point.spread ? shortest((*point.spread)[end]) : "");
      }
      table.rows.push_back(std::move(cells));
    }
  }
  if (every > 1) table.notes.push_back(fmt::format("One of {} points; all of them are in {}.csv.", every, named.name));
  return table;
}

std::string write_diagram(const html::Diagram& diagram, const std::filesystem::path& folder, const std::string& name) {
  const std::string svg = html::svg_file(diagram);
  write_file_atomically(folder / (name + ".svg"), svg);
  std::string pdf, png;
  try {
    const SvgPrinter printer;
    pdf = printer.pdf(svg);
    png = printer.png(svg, png_scale);
  } catch (const OutputError& error) {
    return fmt::format("the diagrams were written only as SVG, not as PDF and PNG: {}", error.what());
  }
  write_file_atomically(folder / (name + ".pdf"), pdf);
  write_file_atomically(folder / (name + ".png"), png);
  return {};
}

std::string write_chart(const NamedChart& chart, const std::filesystem::path& folder) {
  const ResultTable points = points_table(chart);
  write_table(points, folder);
  if (points.rows.size() > most_set_rows) write_set_table(points_table(chart, sparse(points.rows.size())), folder);
  return write_diagram(html::still_chart(chart.chart), folder, chart.name);
}

}  // namespace drape
