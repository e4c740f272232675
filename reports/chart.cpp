#include "reports/chart.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <functional>
#include <sstream>
#include <utility>

#include "core/text.hpp"
#include "drape/scene/scene.hpp"
#include "reports/components.hpp"

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
  points.copied = false;
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
                     copies({"SVG", "PNG", "CSV", "Markdown", "LaTeX"}, chart.title) + points_table(chart));
}

Diagram still_chart(const Chart& chart) { return draw_chart(chart, Medium::file); }

Diagram paper_chart(const Chart& chart, double inches) { return draw_for_paper(chart, inches); }

namespace {

constexpr int wanted_ticks = 6;        // decades with ticks
constexpr std::size_t most_ticks = 7;  // on a linear axis
constexpr std::size_t fewest_ticks = 3;
constexpr double room_around = 0.05;                // margin, as a fraction of the axis
constexpr double room_for_zero = 0.1, near = 0.02;  // fractions of the axis
constexpr double rounding = 1e-9;                   // tolerance for a value beyond its tick

/// Returns a power of ten: "10⁻⁷".
std::string power(int exponent) {
  constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) text += digits[static_cast<std::size_t>(digit - '0')];
  return text;
}

/// Returns a digit times a power of ten: "0.02" or "500" if plain, otherwise "10⁻⁷" or "2·10⁵".
std::string factor_and_power(int factor, int exponent, bool plain) {
  if (plain) return short_number(factor * std::pow(10, exponent));
  return (factor == 1 ? "" : fmt::format("{}·", factor)) + power(exponent);
}

/// Labels for the multiples of a step in one format: "0", "0.5", "1", or "5·10⁻⁶".
class TickLabels {
 public:
  TickLabels(double step, double low, double high) {
    const double largest = std::max(std::abs(low), std::abs(high));
    const int leading = static_cast<int>(std::floor(std::log10(largest) + rounding));
    const int last = static_cast<int>(std::floor(std::log10(step) + rounding));
    if (leading >= most_digits || last < -most_digits) exponent_ = leading;
    decimals_ = std::max(0, exponent_ - last);
  }

  [[nodiscard]] std::string operator()(double value) const {
    if (value == 0) return "0";
    const std::string number = fmt::format("{:.{}f}", std::abs(value) / std::pow(10, exponent_), decimals_);
    return (value < 0 ? "−" : "") + number + (exponent_ == 0 ? "" : "·" + power(exponent_));
  }

 private:
  static constexpr int most_digits = 5;  // before or after the point
  int exponent_ = 0, decimals_ = 0;
};

std::vector<double> multiples(double step, double low, double high) {
  std::vector<double> numbers;
  const double first = std::ceil(low / step - rounding);
  for (int i = 0; first + i <= high / step + rounding; ++i) numbers.push_back((first + i) * step + 0.0);  // + 0: no −0
  return numbers;
}

/// Returns the smallest round step with at most most_ticks ticks on a linear axis.
double round_step(double low, double high) {
  for (double decade = std::pow(10, std::floor(std::log10((high - low) / most_ticks)));; decade *= 10) {
    for (const int factor : {1, 2, 5}) {
      if (multiples(factor * decade, low, high).size() <= most_ticks) return factor * decade;
    }
  }
}

/// Extends the ends of an axis to ticks that are almost there.
void widen(double& low, double& high, double step) {
  const double reach = near * (high - low);
  const double below = std::floor(low / step) * step, above = std::ceil(high / step) * step;
  if (low - below < reach) low = below;
  if (above - high < reach) high = above;
}

}  // namespace

bool is_plain(int lowest, int highest) { return lowest >= -3 && highest <= 3; }

std::string power_of_ten(int exponent, bool plain) { return factor_and_power(1, exponent, plain); }

std::string short_number(double value) { return fmt::format("{:.4g}", value); }

AxisMap::AxisMap(Scale scale, const std::vector<double>& values) : scale_(scale), room_(room_around) {
  double low = INFINITY, high = -INFINITY;
  bool zero = false;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    if (scale == Scale::logarithmic && value <= 0) {
      zero = true;
      continue;
    }
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) low = scale == Scale::linear ? 0 : 0.1, high = 1;
  if (scale == Scale::linear) {
    make_linear(low, high);
    return;
  }
  floor_ = zero ? room_for_zero : 0;
  if (zero) ticks_.push_back({place(0), "0"});
  make_logarithmic(std::log10(low), std::log10(high));
}

AxisMap::AxisMap(const std::vector<std::string>& names)
    : scale_(Scale::linear), low_(-0.5), high_(static_cast<double>(names.size()) - 0.5) {
  constexpr std::size_t room = 80;  // letters, approximately
  std::size_t letters = 0;
  for (const std::string& name : names) letters += name.size() + 1;
  const std::size_t stride = letters / room + 1;
  for (std::size_t i = 0; i < names.size(); i += stride) ticks_.push_back({place(static_cast<double>(i)), names[i]});
}

void AxisMap::make_linear(double low, double high) {
  if (low == high) low -= 0.5 * std::max(1.0, std::abs(low)), high += 0.5 * std::max(1.0, std::abs(high));
  const double step = round_step(low, high);
  widen(low, high, step);
  low_ = low;
  high_ = high;
  const TickLabels label(step, low, high);
  for (const double value : multiples(step, low, high)) ticks_.push_back({place(value), label(value)});
}

void AxisMap::make_logarithmic(double low, double high) {
  if (low == high) low -= 0.5, high += 0.5;
  widen(low, high, 1);
  low_ = low;
  high_ = high;
  const int first = static_cast<int>(std::floor(low + rounding)), last = static_cast<int>(std::floor(high + rounding));
  const int stride = (last - first + wanted_ticks) / (wanted_ticks + 1);
  const bool plain = is_plain(first, last);
  const bool between = high - low < 2.5;  // narrow range: ticks within a decade
  for (int exponent = first; exponent <= last; exponent += std::max(1, stride)) {
    for (const int factor : {1, 2, 5}) {
      const double place_of_it = exponent + std::log10(factor);
      if ((factor > 1 && !between) || place_of_it < low - rounding || place_of_it > high + rounding) continue;
      ticks_.push_back({place(factor * std::pow(10, exponent)), factor_and_power(factor, exponent, plain)});
    }
  }
  if (ticks_.size() >= fewest_ticks + (floor_ > 0 ? 1 : 0)) return;
  ticks_.erase(ticks_.begin() + (floor_ > 0 ? 1 : 0), ticks_.end());
  const double from = std::pow(10, low), to = std::pow(10, high);
  const double step = round_step(from, to);
  const TickLabels label(step, from, to);
  for (const double value : multiples(step, from, to)) ticks_.push_back({place(value), label(value)});
}

double AxisMap::place(double value) const {
  const double between = 1 - 2 * room_;
  if (scale_ == Scale::linear) return room_ + between * (value - low_) / (high_ - low_);
  if (!(value > 0)) return room_;
  return room_ + between * (floor_ + (1 - floor_) * std::clamp((std::log10(value) - low_) / (high_ - low_), 0.0, 1.0));
}

namespace {

/// Lengths in units of the drawing. The defaults are those of a page, which scales the drawing to its width.
struct Layout {
  double width = 640, height = 340, left = 72, right = 24, top = 12, bottom = 50;
  double font = 19;                            // largest font size of labels: in a narrow window, see chart.css
  double gap = 8, below = 18, half_digit = 4;  // from an axis to its labels; from a digit's base to its middle
  double title_base = 8;                       // from the base of the last line to the lower edge
  double sign = 1;                             // scale of the markers
  bool spare = true;                           // draw labels that a narrow window hides, too
  std::vector<std::string> x_title, y_title;   // lines; the latter along the axis; empty: above the drawing
};

// Lengths of a drawing for an article [CSS pixels].
constexpr double inch = 96, paper_line = 12, paper_letter = 0.5;
constexpr double wide_letter = 0.6;       // letter width relative to the font size
constexpr std::size_t styles = 6;         // colours and markers of the style sheet
constexpr std::size_t deepest = 3;        // most distinguished levels of hidden curves
constexpr double least_separation = 2.5;  // least distance of two distinct points
constexpr std::size_t crowded = 60;       // points per series beyond which markers would cover the line

struct Frame {
  AxisMap x, y;
  Layout layout = {};
  [[nodiscard]] double right() const { return layout.width - layout.right; }
  [[nodiscard]] double bottom() const { return layout.height - layout.bottom; }
  [[nodiscard]] double span() const { return right() - layout.left; }
  [[nodiscard]] double rise() const { return bottom() - layout.top; }
  [[nodiscard]] double across(double value) const { return layout.left + span() * x.place(value); }
  [[nodiscard]] double down(double value) const { return bottom() - rise() * y.place(value); }
};

Frame frame_of(const Chart& chart) {
  std::vector<double> xs = chart.x_holds, ys = chart.y_holds;
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) {
      xs.push_back(point.x);
      ys.push_back(point.y);
      if (point.spread) xs.insert(xs.end(), point.spread->begin(), point.spread->end());
    }
  }
  for (const ChartLevel& level : chart.levels) ys.push_back(level.y);
  return {chart.x_names.empty() ? AxisMap(chart.x_scale, xs) : AxisMap(chart.x_names), AxisMap(chart.y_scale, ys)};
}

/// Finds ticks whose labels would overlap the previous label at the font size of a narrow window.
/// @param room  length of the axis
/// @param needs returns the length of a label along the axis
std::vector<bool> overlapping_ticks(const std::vector<AxisMap::Tick>& ticks, double room,
                                    const std::function<double(const std::string&)>& needs) {
  std::vector<bool> spare(ticks.size(), false);
  double taken = -INFINITY;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const double middle = room * ticks[i].place, half = needs(ticks[i].label) / 2;
    spare[i] = middle - half < taken;
    if (!spare[i]) taken = middle + half;
  }
  return spare;
}

/// Returns the titles of both axes.
Markup axis_titles(const Frame& frame) {
  const Layout& layout = frame.layout;
  Markup parts;
  for (std::size_t i = 0; i < layout.x_title.size(); ++i) {
    const double above = paper_line * static_cast<double>(layout.x_title.size() - 1 - i);
    parts += svg_text(layout.left + frame.span() / 2, layout.height - layout.title_base - above, "middle",
                      layout.x_title[i]);
  }
  for (std::size_t i = 0; i < layout.y_title.size(); ++i) {
    const std::string turned = fmt::format("translate({:.1f} {:.1f}) rotate(-90)",
                                           paper_line * (static_cast<double>(i) + 0.8), layout.top + frame.rise() / 2);
    parts += svg_text(0, 0, "middle", layout.y_title[i], {{"transform", turned}});
  }
  return element("g", {{"class", "title"}}, parts);
}

Markup axes(const Frame& frame) {
  Markup parts;
  const Layout& layout = frame.layout;
  const auto label = [&](double x, double y, const std::string& anchor, const std::string& text, bool spare) {
    if (spare && !layout.spare) return Markup();
    return svg_text(x, y, anchor, text, spare ? Attributes{{"class", "spare"}} : Attributes{});
  };
  const auto high = [&](const std::string&) { return layout.font; };
  const auto wide = [&](const std::string& text) { return layout.font * (wide_letter * letters(text) + 0.5); };
  const std::vector<bool> spare_y = overlapping_ticks(frame.y.ticks(), frame.rise(), high);
  for (std::size_t i = 0; i < spare_y.size(); ++i) {
    const double y = frame.bottom() - frame.rise() * frame.y.ticks()[i].place;
    parts += svg_line("grid", layout.left, y, frame.right(), y) +
             label(layout.left - layout.gap, y + layout.half_digit, "end", frame.y.ticks()[i].label, spare_y[i]);
  }
  const std::vector<bool> spare_x = overlapping_ticks(frame.x.ticks(), frame.span(), wide);
  for (std::size_t i = 0; i < spare_x.size(); ++i) {
    const double x = layout.left + frame.span() * frame.x.ticks()[i].place;
    parts += svg_line("grid", x, layout.top, x, frame.bottom()) +
             label(x, frame.bottom() + layout.below, "middle", frame.x.ticks()[i].label, spare_x[i]);
  }
  parts += svg_line("axis", layout.left, layout.top, layout.left, frame.bottom()) +
           svg_line("axis", layout.left, frame.bottom(), frame.right(), frame.bottom());
  return parts + axis_titles(frame);
}

/// A rectangle of the drawing.
struct Box {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Returns true if the line between two points crosses a box (Liang and Barsky 1984).
bool crosses(const Box& box, double x0, double y0, double x1, double y1) {
  double from = 0, to = 1;
  const auto clip = [&](double step, double room) {  // step·t ≤ room
    if (step == 0) return room >= 0;
    const double t = room / step;
    if (step > 0) to = std::min(to, t);
    if (step < 0) from = std::max(from, t);
    return from <= to;
  };
  const double dx = x1 - x0, dy = y1 - y0;
  return clip(-dx, x0 - box.x0) && clip(dx, box.x1 - x0) && clip(-dy, y0 - box.y0) && clip(dy, box.y1 - y0);
}

/// Returns the number of curve segments in a box.
int curves_in(const Box& box, const Chart& chart, const Frame& frame) {
  int count = 0;
  for (const ChartSeries& series : chart.series) {
    const ChartPoint* before = nullptr;
    for (const ChartPoint& point : series.points) {
      const bool seen = std::isfinite(point.x) && std::isfinite(point.y);
      const ChartPoint& from = before != nullptr ? *before : point;
      if (seen && crosses(box, frame.across(from.x), frame.down(from.y), frame.across(point.x), frame.down(point.y))) {
        ++count;
      }
      before = seen ? &point : nullptr;
    }
  }
  return count;
}

/// Returns the label of a level, above or below its line, where it covers the fewest curves; preferably on the right.
Markup level_label(const Chart& chart, const ChartLevel& level, const Frame& frame) {
  constexpr double gap = 4, capitals = 0.75;  // relative to the font size
  constexpr int places = 12;
  const double y = frame.down(level.y), large = frame.layout.font, length = large * wide_letter * letters(level.label);
  const double first = frame.layout.left + gap, last = std::max(first, frame.right() - gap - length);
  int fewest = INT_MAX;
  std::pair<double, double> best;
  bool at_end = false;  // at the end, where a wider font does no harm
  for (const double base : {y - 5, y + 5 + capitals * large}) {
    if (base - large < frame.layout.top || base > frame.bottom()) continue;
    for (int k = places; k >= 0; --k) {
      const double x = first + (last - first) * k / places;
      const int found = curves_in({x - gap, base - large, x + length + gap, base + gap}, chart, frame);
      if (found >= fewest) continue;
      fewest = found;
      best = {x, base};
      at_end = k == places;
    }
  }
  return svg_text(at_end ? frame.right() - gap : best.first, best.second, at_end ? "end" : "start", level.label);
}

Markup levels(const Chart& chart, const Frame& frame) {
  Markup parts;
  for (const ChartLevel& level : chart.levels) {
    const double y = frame.down(level.y);
    parts += level_label(chart, level, frame) + svg_line("level", frame.layout.left, y, frame.right(), y);
  }
  return element("g", {{"class", "levels"}}, parts);
}

/// Returns the marker of a style, around the origin: a circle, a square, a diamond, triangles, a cross.
Markup sign(std::size_t style) {
  constexpr std::array<const char*, styles> paths{"M-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0z",
                                                  "M-3.6 -3.6h7.2v7.2h-7.2z",
                                                  "M0 -5L5 0L0 5L-5 0z",
                                                  "M0 -4.8L4.8 3.6H-4.8z",
                                                  "M0 4.8L4.8 -3.6H-4.8z",
                                                  "M-1.6 -4.6h3.2v3h3v3.2h-3v3h-3.2v-3h-3v-3.2h3z"};
  return element("path", {{"class", "sign"}, {"d", paths[style]}});
}

std::size_t style_of(const Chart& chart, std::size_t number) {
  return chart.series[number].style.value_or(number) % styles;
}

/// Returns true if every point of a curve coincides with a point of another one.
bool lies_under(const ChartSeries& lower, const ChartSeries& upper, const Frame& frame) {
  std::size_t points = 0;
  auto other = upper.points.begin();
  for (const ChartPoint& point : lower.points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
    const auto same = [&](const ChartPoint& p) {
      return std::abs(frame.across(p.x) - frame.across(point.x)) < least_separation &&
             std::abs(frame.down(p.y) - frame.down(point.y)) < least_separation;
    };
    // Points of two curves mostly have the same order, so the search continues from the last match.
    other = std::find_if(other, upper.points.end(), same);
    if (other == upper.points.end()) other = std::find_if(upper.points.begin(), upper.points.end(), same);
    if (other == upper.points.end()) return false;
    ++points;
  }
  return points > 1;
}

/// Returns the first later curve that covers a curve completely, if any.
std::optional<std::size_t> hidden_under(const Chart& chart, std::size_t number, const Frame& frame) {
  for (std::size_t i = number + 1; i < chart.series.size(); ++i) {
    if (lies_under(chart.series[number], chart.series[i], frame)) return i;
  }
  return std::nullopt;
}

/// Returns the number of curves stacked above this one.
std::size_t depth(const Chart& chart, std::size_t number, const Frame& frame) {
  const auto over = hidden_under(chart, number, frame);
  return over ? 1 + depth(chart, *over, frame) : 0;
}

std::string style_class(const Chart& chart, std::size_t number) {
  return fmt::format("s{}{}", style_of(chart, number), chart.series[number].other ? " other" : "");
}

/// Returns true if a series is drawn as a line only.
bool is_line(const ChartSeries& series) { return series.points.size() > crowded || !series.markers; }

Markup draw_point(const ChartSeries& series, const ChartPoint& point, const Markup& sign, const std::string& place,
                  Medium medium) {
  Attributes attributes{{"class", is_line(series) ? "point quiet" : "point"}, {"transform", place}};
  if (medium == Medium::page) {
    attributes.push_back({"data-label", series.name.empty() ? point.label : series.name + ", " + point.label});
    if (!point.command.empty()) attributes.push_back({"data-command", point.command});
  }
  return element("g", attributes, sign);
}

/// Returns a transform that scales; empty for the scale 1.
std::string scaled(double scale) { return scale == 1 ? "" : fmt::format(" scale({:g})", scale); }

Markup draw_series(const Chart& chart, std::size_t number, const Frame& frame, Medium medium) {
  const ChartSeries& series = chart.series[number];
  std::string path;
  Markup points, spreads;
  bool pen_down = false;
  for (const ChartPoint& point : series.points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
      pen_down = false;
      continue;
    }
    const std::string x = coordinate(frame.across(point.x)), y = coordinate(frame.down(point.y));
    path += (pen_down ? "L" : "M") + x + " " + y;
    pen_down = true;
    if (medium == Medium::page || !is_line(series)) {
      const std::string place = "translate(" + x + " " + y + ")" + scaled(frame.layout.sign);
      points += draw_point(series, point, sign(style_of(chart, number)), place, medium);
    }
    if (point.spread) {
      const auto [from, to] = *point.spread;
      spreads += element("path", {{"class", "spread"},
                                  {"d", fmt::format("M{:.1f} {}H{:.1f}", frame.across(from), y, frame.across(to))}});
    }
  }
  std::string style = "series " + style_class(chart, number);
  // A hidden curve is widened, so that it shows on both sides of the curves above.
  if (const std::size_t below = std::min(depth(chart, number, frame), deepest); below > 0) {
    style += fmt::format(" beneath{}", below);
  }
  Attributes attributes{{"class", style}};
  if (medium == Medium::page) attributes.push_back({"data-command", series.command});
  return element("g", attributes, element("path", {{"class", "curve"}, {"d", path}}) + spreads + points);
}

std::vector<LegendEntry> legend_of(const Chart& chart, const Frame& frame) {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    if (chart.series[i].name.empty()) continue;
    Markup key = element("path", {{"class", "curve"}, {"d", "M-12 0L12 0"}});
    if (!is_line(chart.series[i])) key += sign(style_of(chart, i));
    const auto over = hidden_under(chart, i, frame);
    const std::string where = over ? fmt::format(" (beneath {})", chart.series[*over].name) : "";
    entries.push_back({style_class(chart, i), std::move(key), chart.series[i].name + where});
  }
  return entries;
}

/// Breaks a title into lines.
std::vector<std::string> lines_of(const std::string& title, double room) {
  std::vector<std::string> lines;
  std::istringstream text(wrapped(title, static_cast<std::size_t>(room / paper_letter / paper_font)));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// Returns the layout of a drawing for an article, whose margins just hold the labels.
Layout paper_layout(const Chart& chart, const AxisMap& x, const AxisMap& y, double inches) {
  constexpr double least_height = 1.9, share = 0.4;  // [in], and relative to the width
  Layout layout{.width = inch * inches,
                .height = inch * std::max(least_height, share * inches),
                .right = 4,
                .top = 4,
                .font = paper_font,
                .gap = 4,
                .below = 12,
                .half_digit = 3.5,
                .title_base = 3,
                .sign = 0.7,
                .spare = false,
                .x_title = {},
                .y_title = {}};
  double widest = 0;
  for (const AxisMap::Tick& tick : y.ticks()) widest = std::max(widest, letters(tick.label));
  layout.y_title = lines_of(chart.y_title, layout.height - layout.top - 3 * paper_line);
  layout.left = paper_line * static_cast<double>(layout.y_title.size()) + wide_letter * paper_font * (widest + 1) +
                layout.gap + 3;
  if (!x.ticks().empty()) {  // room for the last label's right half
    const AxisMap::Tick& last = x.ticks().back();
    const double half = wide_letter * paper_font * letters(last.label) / 2;
    const double beyond = (1 - last.place) * (layout.width - layout.left - layout.right);
    layout.right = std::max(layout.right, half - beyond);
  }
  layout.x_title = lines_of(chart.x_title, layout.width - layout.left);
  layout.bottom = layout.below + 5 + paper_line * static_cast<double>(layout.x_title.size());
  return layout;
}

Diagram draw(const Chart& chart, const Frame& frame, Medium medium) {
  Markup drawing = axes(frame);
  for (std::size_t i = 0; i < chart.series.size(); ++i) drawing += draw_series(chart, i, frame, medium);
  drawing += levels(chart, frame);
  return {chart.title,
          frame.layout.y_title.empty() ? chart.y_title : "",
          legend_of(chart, frame),
          frame.layout.width,
          frame.layout.height,
          std::move(drawing)};
}

}  // namespace

Diagram draw_chart(const Chart& chart, Medium medium) {
  Frame frame = frame_of(chart);
  frame.layout.x_title = {chart.x_title};
  return draw(chart, frame, medium);
}

Diagram draw_for_paper(const Chart& chart, double inches) {
  Frame frame = frame_of(chart);
  frame.layout = paper_layout(chart, frame.x, frame.y, inches);
  return draw(chart, frame, Medium::file);
}

}  // namespace drape::html

namespace drape {

html::ChartSeries method_series(const std::string& name) {
  // Additions to a method's name, such as a source or a scheme, keep its colour and marker, but are dashed.
  std::string method = name.substr(0, name.find(','));
  for (const std::string_view scheme : scheme_names) method = method.substr(0, method.find("-" + std::string(scheme)));
  const auto* const place = std::find(method_names.begin(), method_names.end(), method);
  html::ChartSeries series{name, {}};
  series.style = static_cast<std::size_t>(place - method_names.begin());
  series.other = method != name;
  return series;
}

}  // namespace drape
