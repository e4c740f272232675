#include "html/chart.hpp"

#include <algorithm>
#include <cmath>

#include "html/chart_drawing.hpp"
#include "html/components.hpp"

namespace drape::html {
namespace {

constexpr std::size_t table_rows = 500;  // longer tables are not useful on a page

/// Returns the commands that make whole series.
Markup series_commands(const Chart& chart) {
  Markup commands;
  for (const ChartSeries& series : chart.series) {
    if (!series.command.empty()) commands += command(series.name, series.command);
  }
  return commands;
}

/// Returns the points as a table; empty columns of series names or commands are omitted.
Markup points_table(const Chart& chart) {
  const bool named = std::ranges::any_of(chart.series, [](const ChartSeries& s) { return !s.name.empty(); });
  const bool commanded = std::ranges::any_of(chart.series, [](const ChartSeries& s) {
    return std::ranges::any_of(s.points, [](const ChartPoint& p) { return !p.command.empty(); });
  });
  Table points{chart.title, {{chart.x_title, true}, {chart.y_title, true}}, {}};
  if (named) points.columns.insert(points.columns.begin(), {"Series"});
  if (commanded) points.columns.push_back({"Command"});
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) {
      if (points.rows.size() == table_rows) break;
      if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
      const std::string x =
          chart.x_names.empty() ? short_number(point.x) : chart.x_names.at(static_cast<std::size_t>(point.x));
      std::vector<Markup> cells{x, short_number(point.y)};
      if (named) cells.insert(cells.begin(), series.name);
      if (commanded) cells.push_back(point.command.empty() ? Markup() : code(point.command));
      points.rows.push_back(std::move(cells));
    }
  }
  return details("Points as a table", series_commands(chart) + table(points));
}

}  // namespace

Markup chart(const Chart& chart) {
  const Diagram diagram = draw_chart(chart, Medium::page);
  const Markup svg =
      inline_svg(diagram, {{"tabindex", "0"}, {"aria-label", chart.title + " Arrow keys go from point to point."}});
  return element("figure", {{"class", "chart"}},
                 element("figcaption", chart.title) + legend(diagram.legend) +
                     element("p", {{"class", "axis-title"}}, chart.y_title) + svg +
                     copies({"SVG", "PNG"}, chart.title) + points_table(chart));
}

Diagram still_chart(const Chart& chart) { return draw_chart(chart, Medium::file); }

}  // namespace drape::html
