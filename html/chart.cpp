#include "html/chart.hpp"

#include "html/chart_drawing.hpp"
#include "html/components.hpp"

namespace drape::html {
namespace {

constexpr std::size_t table_rows = 500;  // more would be no help to anybody

/// The commands that make whole series.
Markup series_commands(const Chart& chart) {
  Markup commands;
  for (const ChartSeries& series : chart.series) {
    if (!series.command.empty()) commands += command(series.name, series.command);
  }
  return commands;
}

Markup points_table(const Chart& chart) {
  Table points{chart.title, {{"Series"}, {chart.x_title, true}, {chart.y_title, true}, {"Command"}}, {}};
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) {
      if (points.rows.size() == table_rows) break;
      const std::string x =
          chart.x_names.empty() ? short_number(point.x) : chart.x_names.at(static_cast<std::size_t>(point.x));
      points.rows.push_back(
          {series.name, x, short_number(point.y), point.command.empty() ? Markup() : code(point.command)});
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
