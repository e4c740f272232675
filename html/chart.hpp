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
  std::string label;    ///< text of the tooltip: "step 37: 2.1 mm"
  std::string command;  ///< commands that reproduce this point, a line each; may be empty
  /// Range of x, drawn as a bar.
  std::optional<std::array<double, 2>> spread = {};
};

struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points;
  bool markers = true;                    ///< a marker at every point; otherwise only the line
  std::string command = {};               ///< command that reproduces every point without its own; may be empty
  std::optional<std::size_t> style = {};  ///< index of colour and marker; absent: position in the chart
  bool other = false;                     ///< dashed with open markers: another source for the series of the same style
};

/// A reference level, drawn across the chart.
struct ChartLevel {
  double y = 0;
  std::string label;
};

/// Data series with two axes.
struct Chart {
  std::string title;  ///< description in a sentence, also for screen readers
  std::string x_title, y_title;
  Scale x_scale = Scale::linear, y_scale = Scale::linear;
  std::vector<ChartSeries> series;
  std::vector<ChartLevel> levels;
  std::vector<std::string> x_names = {};  ///< names of the places 0, 1, 2… on a horizontal axis without numbers
  std::vector<double> x_holds = {}, y_holds = {};  ///< values that the axes must include
};

/// Returns a chart as inline SVG with a legend. A point under the pointer or selected with the arrow keys shows its
/// label and command. A table lists the points as well. Non-finite points are omitted and leave a gap in the line.
Markup chart(const Chart& chart);

/// Returns the chart for a separate file: only the visible points.
Diagram still_chart(const Chart& chart);

}  // namespace drape::html
