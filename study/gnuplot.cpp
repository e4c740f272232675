#include "study/gnuplot.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/atomic_file.hpp"
#include "core/shell.hpp"

namespace drape {
namespace {

/// Between double quotes, as gnuplot reads it. With them a text is plain: "noenhanced" is set.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n') {
      result += "\\n";
    } else {
      result += c;
    }
  }
  return result + "\"";
}

/// Cut into lines where it would not fit into a picture.
std::string wrapped(const std::string& text) {
  constexpr std::size_t widest = 72;  // bytes
  std::string result;
  std::size_t width = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::size_t length = end - begin;
    const bool cut = width > 0 && width + 1 + length > widest;
    if (width > 0) result += cut ? '\n' : ' ';
    result.append(text, begin, length);
    width = cut || width == 0 ? length : width + 1 + length;
    begin = end + 1;
  }
  return result;
}

bool has_spread(const html::ChartSeries& series) {
  return std::any_of(series.points.begin(), series.points.end(), [](const auto& p) { return p.spread.has_value(); });
}

/// One block of lines for each series, so that each is a data set of its own: index 0, 1, …
std::string points_csv(const html::Chart& chart) {
  std::string text = fmt::format("# series,{},{}", chart.x_title, chart.y_title);
  const bool spread = std::any_of(chart.series.begin(), chart.series.end(), has_spread);
  text += spread ? ",from,to\n" : "\n";
  for (const html::ChartSeries& series : chart.series) {
    for (const html::ChartPoint& point : series.points) {
      if (std::isfinite(point.y)) {
        text += fmt::format("\"{}\",{:.17g},{:.17g}", series.name, point.x, point.y);
        if (point.spread) text += fmt::format(",{:.17g},{:.17g}", (*point.spread)[0], (*point.spread)[1]);
      }
      text += "\n";
    }
    text += "\n\n";
  }
  return text;
}

std::string script(const html::Chart& chart, const std::string& name) {
  std::string text = fmt::format(
      "# gnuplot {0}.gp draws {0}.svg and {0}.png from {0}.csv.\n"
      "set datafile separator ','\nset encoding utf8\nset title {1} noenhanced\nset xlabel {2} noenhanced offset "
      "0,0.4\n"
      "set ylabel {3} noenhanced\nset key outside below noenhanced\nset grid lt 1 lc rgb '#dddddd'\nset border 3\n"
      "set tics nomirror\n",
      name, quoted(wrapped(chart.title)), quoted(chart.x_title), quoted(chart.y_title));
  if (chart.x_scale == html::Scale::logarithmic) text += "set logscale x\nset format x '10^{%L}'\n";
  if (chart.y_scale == html::Scale::logarithmic) text += "set logscale y\nset format y '10^{%L}'\n";
  std::string plots;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const bool spread = has_spread(chart.series[i]);
    const char* style = spread                    ? "xerrorlines pt 7 ps 0.6"
                        : chart.series[i].markers ? "linespoints pt 7 ps 0.6"
                                                  : "lines";
    plots +=
        fmt::format("{}'{}.csv' index {} using {} with {} lw 1.5 title {}", plots.empty() ? "plot " : ", \\\n     ",
                    name, i, spread ? "2:3:4:5" : "2:3", style, quoted(chart.series[i].name));
  }
  for (const html::ChartLevel& level : chart.levels) {
    plots += fmt::format(", \\\n     {} with lines dt 2 title {}", level.y, quoted(level.label));
  }
  text += fmt::format("set terminal svg size 800,480 font 'DejaVu Sans,13'\nset output '{}.svg'\n{}\n", name, plots);
  text +=
      fmt::format("set terminal pngcairo size 1200,720 font 'DejaVu Sans,16'\nset output '{}.png'\n{}\n", name, plots);
  return text;
}

}  // namespace

std::string write_plot(const html::Chart& chart, const std::filesystem::path& folder, const std::string& name) {
  write_file_atomically(folder / (name + ".csv"), points_csv(chart));
  write_file_atomically(folder / (name + ".gp"), script(chart, name));
  return draw_with_gnuplot(folder, name);
}

std::string draw_with_gnuplot(const std::filesystem::path& folder, const std::string& name) {
  const int status = std::system(
      fmt::format("cd {} && gnuplot {} >/dev/null 2>&1", shell_word(folder.string()), shell_word(name + ".gp"))
          .c_str());
  if (status == 0) return {};
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) {
    return "gnuplot is not installed, so the plots are there as .csv and .gp files only; on Debian: apt-get install "
           "gnuplot-nox";
  }
  return fmt::format("gnuplot could not draw {}; its data and script are there", (folder / (name + ".gp")).string());
}

}  // namespace drape
