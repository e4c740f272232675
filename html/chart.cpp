#include "html/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "html/components.hpp"

namespace drape::html {
namespace {

// In the units of the drawing, which is scaled to the page.
constexpr double width = 640, height = 340, left = 72, right = 24, top = 12, bottom = 50;
constexpr std::size_t styles = 6;        // colours and signs of the style sheet
constexpr std::size_t crowded = 60;      // points in a series from which on signs would cover the line
constexpr std::size_t table_rows = 500;  // more would be no help to anybody

std::string coordinate(double value) { return fmt::format("{:.1f}", value); }

struct Frame {
  AxisMap x, y;
  [[nodiscard]] double across(double value) const { return left + (width - left - right) * x.place(value); }
  [[nodiscard]] double down(double value) const { return height - bottom - (height - top - bottom) * y.place(value); }
};

Frame frame_of(const Chart& chart) {
  std::vector<double> xs, ys;
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) {
      xs.push_back(point.x);
      ys.push_back(point.y);
      if (point.spread) xs.insert(xs.end(), point.spread->begin(), point.spread->end());
    }
  }
  for (const ChartLevel& level : chart.levels) ys.push_back(level.y);
  return {AxisMap(chart.x_scale, xs), AxisMap(chart.y_scale, ys)};
}

Markup text(double x, double y, const std::string& anchor, const std::string& content) {
  return element("text", {{"x", coordinate(x)}, {"y", coordinate(y)}, {"text-anchor", anchor}}, content);
}

Markup line(const std::string& style, double x1, double y1, double x2, double y2) {
  return element("line", {{"class", style},
                          {"x1", coordinate(x1)},
                          {"y1", coordinate(y1)},
                          {"x2", coordinate(x2)},
                          {"y2", coordinate(y2)}});
}

Markup axes(const Chart& chart, const Frame& frame) {
  Markup parts;
  const double span = width - left - right, rise = height - top - bottom;
  for (const AxisMap::Tick& tick : frame.y.ticks()) {
    const double y = height - bottom - rise * tick.place;
    parts += line("grid", left, y, width - right, y) + text(left - 8, y + 4, "end", tick.label);
  }
  for (const AxisMap::Tick& tick : frame.x.ticks()) {
    const double x = left + span * tick.place;
    parts += line("grid", x, top, x, height - bottom) + text(x, height - bottom + 18, "middle", tick.label);
  }
  parts += element("g", {{"class", "title"}}, text(left + span / 2, height - 8, "middle", chart.x_title));
  return parts;
}

Markup levels(const Chart& chart, const Frame& frame) {
  Markup parts;
  for (const ChartLevel& level : chart.levels) {
    const double y = frame.down(level.y);
    parts += line("level", left, y, width - right, y) +
             text(width - right - 4, y > top + 16 ? y - 5 : y + 14, "end", level.label);
  }
  return element("g", {{"class", "levels"}}, parts);
}

/// The sign of a style, around the origin.
std::string sign_path(std::size_t style) {
  switch (style % 3) {
    case 0:
      return "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0z";
    case 1:
      return "M-3.6 -3.6h7.2v7.2h-7.2z";
    default:
      return "M0 -5L5 0L0 5L-5 0z";
  }
}

Markup sign(std::size_t style) { return element("path", {{"class", "sign"}, {"d", sign_path(style)}}); }

Markup draw(const ChartSeries& series, std::size_t style, const Frame& frame) {
  std::string path;
  Markup points, spreads;
  bool pen_down = false;
  const bool crowd = series.points.size() > crowded || !series.markers;
  for (const ChartPoint& point : series.points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
      pen_down = false;
      continue;
    }
    const std::string x = coordinate(frame.across(point.x)), y = coordinate(frame.down(point.y));
    path += (pen_down ? "L" : "M") + x + " " + y;
    pen_down = true;
    Attributes attributes{{"class", crowd ? "point quiet" : "point"}, {"transform", "translate(" + x + " " + y + ")"}};
    attributes.push_back({"data-label", series.name.empty() ? point.label : series.name + ", " + point.label});
    if (!point.command.empty()) attributes.push_back({"data-command", point.command});
    points += element("g", attributes, sign(style));
    if (point.spread) {
      const auto [from, to] = *point.spread;
      spreads += element("path", {{"class", "spread"},
                                  {"d", fmt::format("M{:.1f} {}H{:.1f}", frame.across(from), y, frame.across(to))}});
    }
  }
  return element("g", {{"class", fmt::format("series s{}", style)}, {"data-command", series.command}},
                 element("path", {{"class", "curve"}, {"d", path}}) + spreads + points);
}

Markup legend(const Chart& chart) {
  Markup entries;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    if (chart.series[i].name.empty()) continue;
    const Markup key = element(
        "svg", {{"class", fmt::format("key s{}", i % styles)}, {"viewBox", "-12 -7 24 14"}, {"aria-hidden", "true"}},
        element("path", {{"class", "curve"}, {"d", "M-12 0L12 0"}}) + sign(i % styles));
    entries += element("li", key + chart.series[i].name);
  }
  return entries.empty() ? entries : element("ul", {{"class", "legend"}}, entries);
}

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
      points.rows.push_back({series.name, short_number(point.x), short_number(point.y),
                             point.command.empty() ? Markup() : code(point.command)});
    }
  }
  return details("Points as a table", series_commands(chart) + table(points));
}

}  // namespace

Markup chart(const Chart& chart) {
  const Frame frame = frame_of(chart);
  Markup drawing = axes(chart, frame);
  for (std::size_t i = 0; i < chart.series.size(); ++i) drawing += draw(chart.series[i], i % styles, frame);
  drawing += levels(chart, frame);
  const Markup svg = element("svg",
                             {{"viewBox", fmt::format("0 0 {} {}", width, height)},
                              {"role", "img"},
                              {"tabindex", "0"},
                              {"aria-label", chart.title + " Arrow keys go from point to point."}},
                             drawing);
  return element("figure", {{"class", "chart"}},
                 element("figcaption", chart.title) + legend(chart) +
                     element("p", {{"class", "axis-title"}}, chart.y_title) + svg + points_table(chart));
}

}  // namespace drape::html
