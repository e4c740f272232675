#include "reports/pgfplots.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/files.hpp"
#include "reports/latex.hpp"

namespace drape {
namespace {

/// Markers in the order of the charts' styles: circle, square, diamond, triangles, and for the cross a pentagon.
constexpr std::array<const char*, 6> marks{
    "mark=*",        "mark=square*", "mark=diamond*", "mark=triangle*", "mark=triangle*, mark options={rotate=180}",
    "mark=pentagon*"};

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "nan"; }

std::size_t style_of(const html::Chart& chart, std::size_t i) {
  return chart.series[i].style.value_or(i) % marks.size();
}

/// Returns the definitions of the colours in use.
std::string colors(const html::Chart& chart) {
  std::set<std::size_t> used;
  for (std::size_t i = 0; i < chart.series.size(); ++i) used.insert(style_of(chart, i));
  std::string text;
  for (const std::size_t style : used) {
    std::string color = html::light_color(fmt::format("--s{}", style)).substr(1);
    std::ranges::transform(color, color.begin(), [](unsigned char c) { return std::toupper(c); });
    text += fmt::format("\\definecolor{{drape{}}}{{HTML}}{{{}}}\n", style, color);
  }
  return text;
}

/// Returns invisible points that the axes must include.
std::string held_points(const html::Chart& chart) {
  double x = NAN, y = NAN;
  for (const html::ChartSeries& series : chart.series) {
    for (const html::ChartPoint& p : series.points) {
      if (std::isfinite(p.x) && std::isfinite(p.y) && p.x > 0 && p.y > 0) x = p.x, y = p.y;
    }
  }
  if (std::isnan(x)) return {};
  std::string points;
  for (const double held : chart.x_holds) points += fmt::format(" ({},{})", held, y);
  for (const double held : chart.y_holds) points += fmt::format(" ({},{})", x, held);
  for (const html::ChartLevel& level : chart.levels) points += fmt::format(" ({},{})", x, level.y);
  return points.empty() ? points : fmt::format("\\addplot[draw=none, forget plot] coordinates {{{} }};\n", points);
}

std::string level_line(const html::ChartLevel& level) {
  return fmt::format(
      "\\draw[dashed] ({{rel axis cs:0,0}} |- {{axis cs:\\pgfkeysvalueof{{/pgfplots/xmin}},{0}}}) -- "
      "({{rel axis cs:1,0}} |- {{axis cs:\\pgfkeysvalueof{{/pgfplots/xmin}},{0}}}) node[above left] {{{1}}};\n",
      number(level.y), html::latex(level.label));
}

std::string axis_options(const html::Chart& chart, double inches) {
  constexpr double least_height = 2.1, share = 0.42;  // [in], and relative to the width
  std::size_t longest = 0;
  for (const html::ChartSeries& series : chart.series) longest = std::max(longest, series.name.size());
  const double entry = 36 + 4.5 * static_cast<double>(longest);  // of the legend [pt]
  const auto columns = std::max<std::size_t>(1, static_cast<std::size_t>((72 * inches - 40) / entry));
  std::vector<std::string> options{
      fmt::format("width={:g}in, height={:g}in", inches, std::max(least_height, share * inches)),
      "font=\\footnotesize",
      fmt::format("xlabel={{{}}}", html::latex(chart.x_title)),
      fmt::format("ylabel={{{}}}", html::latex(chart.y_title)),
      "enlargelimits=0.05, grid=major, grid style={very thin, gray!40}",
      "unbounded coords=jump, mark size=1.2pt",
      "legend style={at={(0,1.03)}, anchor=south west, draw=none, font=\\footnotesize}",
      fmt::format("legend columns={}", columns),
      "legend cell align=left"};
  if (chart.x_scale == html::Scale::logarithmic) options.emplace_back("xmode=log");
  if (chart.y_scale == html::Scale::logarithmic) options.emplace_back("ymode=log");
  if (!chart.x_names.empty()) {
    std::vector<std::string> places, names;
    for (std::size_t i = 0; i < chart.x_names.size(); ++i) {
      places.push_back(std::to_string(i));
      names.push_back("{" + html::latex(chart.x_names[i]) + "}");
    }
    options.push_back(fmt::format("xtick={{{}}}, xticklabels={{{}}}", fmt::join(places, ","), fmt::join(names, ",")));
  }
  return fmt::format("  {}", fmt::join(options, ",\n  "));
}

}  // namespace

std::string pgfplots_data(const html::Chart& chart) {
  std::vector<std::string> names;
  std::size_t rows = 0;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    names.push_back(fmt::format("x{0} y{0}", i));
    rows = std::max(rows, chart.series[i].points.size());
  }
  std::string text = fmt::format("{}\n", fmt::join(names, " "));
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<std::string> cells;
    for (const html::ChartSeries& series : chart.series) {
      const bool known = row < series.points.size();
      cells.push_back(known ? number(series.points[row].x) : "nan");
      cells.push_back(known ? number(series.points[row].y) : "nan");
    }
    text += fmt::format("{}\n", fmt::join(cells, " "));
  }
  return text;
}

std::string pgfplots_picture(const NamedChart& named, double inches) {
  const html::Chart& chart = named.chart;
  constexpr std::size_t crowded = 60;  // points per series beyond which markers would cover the line
  std::string plots;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const html::ChartSeries& series = chart.series[i];
    const bool line = !series.markers || series.points.size() > crowded;
    plots +=
        fmt::format("\\addplot[color=drape{}, {}{}] table[x=x{}, y=y{}] {{{}.dat}};\n", style_of(chart, i),
                    line ? "no marks" : marks[style_of(chart, i)], series.other ? ", dashed" : "", i, i, named.name);
    if (!series.name.empty()) plots += fmt::format("\\addlegendentry{{{}}}\n", html::latex(series.name));
  }
  plots += held_points(chart);
  for (const html::ChartLevel& level : chart.levels) plots += level_line(level);
  return fmt::format(
      "% {}\n% needs \\usepackage{{pgfplots}} and \\pgfplotsset{{compat=1.18}}; of another folder also\n"
      "% \\pgfplotsset{{table/search "
      "path={{FOLDER}}}}\n{}\\begin{{tikzpicture}}\n\\begin{{axis}}[\n{}]\n{}\\end{{axis}}\n"
      "\\end{{tikzpicture}}\n",
      html::latex(chart.title), colors(chart), axis_options(chart, inches), plots);
}

void write_pgfplots(const NamedChart& chart, const std::filesystem::path& folder, double inches) {
  write_file_atomically(folder / (chart.name + ".dat"), pgfplots_data(chart.chart));
  write_file_atomically(folder / (chart.name + ".tikz.tex"), pgfplots_picture(chart, inches));
}

}  // namespace drape
