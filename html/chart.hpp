#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "html/chart_axis.hpp"
#include "html/diagram.hpp"
#include "html/markup.hpp"

namespace drape::html {

struct ChartPoint {
  double x = 0, y = 0;
  std::string label;    ///< what the point says when it is pointed at: "step 37: 2.1 mm"
  std::string command;  ///< that makes this point again, or several, a line each; may be empty
  /// How far x was found to spread, from and to: drawn as a bar.
  std::optional<std::array<double, 2>> spread = {};
};

struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points;
  bool markers = true;                    ///< a sign at every point, or only the line through them
  std::string command = {};               ///< that makes every point which has none of its own; may be empty
  std::optional<std::size_t> style = {};  ///< its colour and sign; absent: those of its place in the chart
  bool other = false;  ///< dashed, with open signs: another source of what a series of the same style shows
};

/// A level to compare with, drawn across the chart.
struct ChartLevel {
  double y = 0;
  std::string label;
};

/// Series of points against two axes.
struct Chart {
  std::string title;  ///< what it shows, in a sentence: also for who cannot see it
  std::string x_title, y_title;
  Scale x_scale = Scale::linear, y_scale = Scale::linear;
  std::vector<ChartSeries> series;
  std::vector<ChartLevel> levels;
  std::vector<std::string> x_names = {};  ///< of the places 0, 1, 2… where the horizontal axis has no numbers
  std::vector<double> x_holds = {}, y_holds = {};  ///< values that an axis has in any case
};

/// A chart as inline SVG with a legend. A point that is pointed at, or reached with the arrow keys, shows its label
/// and its command. The points are also there as a table.
/// Points that are not finite are left out, and the line has a gap there.
Markup chart(const Chart& chart);

/// The same for a file of its own: no points but those that are seen.
Diagram still_chart(const Chart& chart);

}  // namespace drape::html
