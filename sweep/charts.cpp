#include "sweep/charts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "study/method_series.hpp"

namespace drape {
namespace {

constexpr std::size_t most_lines = 12;
constexpr double wide = 30;  // ratio of largest to smallest value that makes an axis logarithmic

std::optional<double> number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Returns the values of an axis as numbers; empty if any is not a number.
std::vector<double> numbers_of(const SweepAxis& axis) {
  std::vector<double> values;
  for (const std::string& text : axis.values) {
    const auto value = number(text);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

html::Scale scale_of(const std::vector<double>& values) {
  double low = INFINITY, high = 0;
  for (const double value : values) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return low > 0 && high >= wide * low ? html::Scale::logarithmic : html::Scale::linear;
}

/// Returns the numeric figures that vary, in the order of the runs' records.
std::vector<std::string> changing_figures(const SweepResults& results) {
  std::vector<std::string> names;
  std::map<std::string, std::set<std::string>> values;
  for (const SweepRow& row : results.rows) {
    for (const auto& [name, value] : row.record.figures) {
      if (!number(value)) continue;
      if (values[name].empty()) names.push_back(name);
      values[name].insert(value);
    }
  }
  std::erase_if(names, [&](const std::string& name) { return values[name].size() < 2; });
  // The first figure is shown first.
  const auto preferred = [](const std::string& name) {
    return name == "step_us.median" ? 0 : name == "iterations.mean" ? 1 : 2;
  };
  std::ranges::stable_sort(names, std::less(), preferred);
  return names;
}

/// Returns the axes that distinguish the lines of a diagram over one axis.
std::vector<std::size_t> line_axes(const SweepResults& results, std::size_t over) {
  std::vector<std::size_t> others;
  std::size_t lines = 1;
  for (std::size_t a = 0; a < results.axes.size(); ++a) {
    if (a == over) continue;
    others.push_back(a);
    lines *= results.axes[a].values.size();
  }
  if (lines <= most_lines) return others;
  std::ranges::reverse(others);  // among equals, prefer the axis that changes fastest
  const std::size_t fewest =
      *std::ranges::min_element(others, std::less(), [&](std::size_t a) { return results.axes[a].values.size(); });
  return {fewest};
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// Returns a file name that needs no quotes in any context.
std::string file_name(std::string text) {
  const auto strange = [](unsigned char c) { return std::isalnum(c) == 0 && c != '_' && c != '-' && c != '.'; };
  std::ranges::replace_if(text, strange, '-');
  return text;
}

NamedChart diagram(const SweepResults& results, const std::string& figure, std::size_t over) {
  using Line = std::map<double, std::vector<double>>;  // the figure's values by place on the axis
  const SweepAxis& axis = results.axes[over];
  const std::vector<double> numbers = numbers_of(axis);
  const std::vector<std::size_t> apart = line_axes(results, over);
  std::map<std::vector<std::size_t>, Line> lines;
  std::vector<double> all;
  bool medians = false;
  for (const SweepRow& row : results.rows) {
    const auto value = number(row.record.figure(figure));
    if (!value) continue;
    std::vector<std::size_t> line;
    for (const std::size_t a : apart) line.push_back(row.places[a]);
    const std::size_t place = row.places[over];
    std::vector<double>& values = lines[line][numbers.empty() ? static_cast<double>(place) : numbers[place]];
    values.push_back(*value);
    medians = medians || values.size() > 1;
    all.push_back(*value);
  }
  html::Chart chart;
  chart.title =
      fmt::format("{} over {}{}", figure_title(figure), axis.name, medians ? ", medians over the other keys" : "");
  chart.x_title = axis.name;
  chart.y_title = figure_title(figure);
  chart.y_scale = scale_of(all);
  if (numbers.empty()) {
    chart.x_names = axis.values;
  } else {
    chart.x_scale = scale_of(numbers);
  }
  for (const auto& [places, line] : lines) {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < apart.size(); ++i) {
      const SweepAxis& other = results.axes[apart[i]];
      parts.push_back(fmt::format("{} {}", other.name.substr(other.name.rfind('.') + 1), other.values[places[i]]));
    }
    html::ChartSeries series;
    const bool by_method = apart.size() == 1 && results.axes[apart[0]].name == "integrator.method";
    if (by_method) series = method_series(results.axes[apart[0]].values[places[0]]);
    series.name = fmt::format("{}", fmt::join(parts, ", "));
    for (const auto& [x, values] : line) {
      const double y = median(values);
      const std::string at = numbers.empty() ? axis.values[static_cast<std::size_t>(x)] : fmt::format("{:.6g}", x);
      series.points.push_back({x, y, fmt::format("{} = {}: {:.4g}", axis.name, at, y), {}});
    }
    if (!by_method) series.other = chart.series.size() >= 6;  // there are six colours
    chart.series.push_back(std::move(series));
  }
  return {file_name(fmt::format("{}-over-{}", figure, axis.name)), std::move(chart)};
}

}  // namespace

std::string figure_title(const std::string& name) {
  static const std::map<std::string, std::string> titles{
      {"step_us.median", "µs per step (median)"},
      {"step_us.mean", "µs per step (mean)"},
      {"iterations.mean", "iterations per step"},
      {"iterations.max", "most iterations of a step"},
      {"iterations.steps_not_converged", "steps that did not converge"},
      {"iterations.worst_residual", "worst residual [N]"},
      {"accuracy.estimated_error.mean", "estimated error of a step [m]"},
      {"accuracy.estimated_error.largest", "largest estimated error of a step [m]"},
      {"accuracy.substeps.mean", "substeps per step"},
      {"accuracy.unbalanced_at_rest.force", "unbalanced force at rest [N]"}};
  const auto found = titles.find(name);
  return found == titles.end() ? name : found->second;
}

SweepDiagrams figure_diagrams(const SweepResults& results) {
  SweepDiagrams diagrams{.figures = changing_figures(results), .axes = {}, .charts = {}};
  for (const SweepAxis& axis : results.axes) diagrams.axes.push_back(axis.name);
  for (const std::string& figure : diagrams.figures) {
    for (std::size_t a = 0; a < diagrams.axes.size(); ++a) diagrams.charts.push_back(diagram(results, figure, a));
  }
  return diagrams;
}

html::Choices choices_of(const SweepDiagrams& diagrams) {
  html::Choices choices;
  std::vector<std::string> titles;
  for (const std::string& figure : diagrams.figures) titles.push_back(figure_title(figure));
  choices.lists = {{"Figure", titles}, {"over", diagrams.axes}};
  for (std::size_t i = 0; i < diagrams.charts.size(); ++i) {
    choices.pieces.push_back(
        {{i / diagrams.axes.size(), i % diagrams.axes.size()}, html::chart(diagrams.charts[i].chart)});
  }
  return choices;
}

}  // namespace drape
