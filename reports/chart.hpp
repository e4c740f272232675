#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "reports/diagram.hpp"
#include "reports/page.hpp"

namespace drape::html {

enum class Scale { linear, logarithmic };

/// Map from values to positions on an axis, with margins and ticks at round numbers. On a logarithmic axis, values of
/// zero or less share a position below the smallest positive value.
class AxisMap {
 public:
  struct Tick {
    double place = 0;  ///< 0 at the start to 1 at the end of the axis
    std::string label;
  };

  /// @param values values to include; non-finite ones are ignored
  AxisMap(Scale scale, const std::vector<double>& values);

  /// Makes an axis of names instead of numbers, at 0, 1, 2…
  explicit AxisMap(const std::vector<std::string>& names);

  /// Returns the position of a value: 0 at the start to 1 at the end.
  [[nodiscard]] double place(double value) const;
  [[nodiscard]] const std::vector<Tick>& ticks() const { return ticks_; }

 private:
  void make_linear(double low, double high);
  void make_logarithmic(double low, double high);

  Scale scale_;
  double low_ = 0, high_ = 1;  // range of the values, or of their decimal logarithms
  double floor_ = 0;           // fraction between the margins that is reserved for zero
  double room_ = 0;            // margin at both ends, as a fraction of the axis
  std::vector<Tick> ticks_;
};

/// Returns true if an axis writes powers of ten with these exponents as "0.01" and "100". All of its ticks have the
/// same format.
bool is_plain(int lowest, int highest);

/// Returns 10 to a power: "0.01" or "10⁻²".
std::string power_of_ten(int exponent, bool plain);

/// Formats a number: "0.25", "1e-06".
std::string short_number(double value);

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

/// Returns the chart for paper_file(): of this width, with the title of the vertical axis along it.
Diagram paper_chart(const Chart& chart, double inches);

/// Purpose of a drawing.
enum class Medium {
  page,  ///< every point has its label and its command, even if only the line is visible
  file   ///< only visible parts
};

Diagram draw_chart(const Chart& chart, Medium medium);

/// Draws a chart at its size in an article. @param inches width
Diagram draw_for_paper(const Chart& chart, double inches);

}  // namespace drape::html

namespace drape {

/// Returns an empty series with its method's colour and marker, the same in every diagram. A name with an addition
/// ("liu13, report") makes it dashed, with open markers.
html::ChartSeries method_series(const std::string& name);

}  // namespace drape
