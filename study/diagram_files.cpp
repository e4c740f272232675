#include "study/diagram_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "scene/method_names.hpp"
#include "study/case.hpp"
#include "study/svg_printer.hpp"

namespace drape {
namespace {

constexpr double png_scale = 2;

}  // namespace

html::ChartSeries method_series(const std::string& name) {
  // A source and a scheme of a method have its colour and sign, and are dashed.
  const std::string method = name.substr(0, std::min(name.find(','), name.find("-sdirk2")));
  const auto* const place = std::find(method_names.begin(), method_names.end(), method);
  html::ChartSeries series{name, {}};
  series.style = static_cast<std::size_t>(place - method_names.begin());
  series.other = method != name;
  return series;
}

ResultTable points_table(const NamedChart& named) {
  const html::Chart& chart = named.chart;
  const bool spread = std::ranges::any_of(chart.series, [](const html::ChartSeries& series) {
    return std::ranges::any_of(series.points, [](const html::ChartPoint& p) { return p.spread.has_value(); });
  });
  ResultTable table{named.name, chart.title, {"series", chart.x_title, chart.y_title}, {}, {}};
  if (spread) table.columns.insert(table.columns.end(), {"from", "to"});
  for (const html::ChartSeries& series : chart.series) {
    for (const html::ChartPoint& point : series.points) {
      if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
      table.rows.push_back({series.name, plain_number(point.x), plain_number(point.y)});
      if (!spread) continue;
      for (const std::size_t end : {0U, 1U}) {
        table.rows.back().push_back(point.spread ? plain_number((*point.spread)[end]) : "");
      }
    }
  }
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
  write_table(points_table(chart), folder);
  return write_diagram(html::still_chart(chart.chart), folder, chart.name);
}

}  // namespace drape
