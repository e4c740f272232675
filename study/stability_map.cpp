#include "study/stability_map.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "drape/scene/scene.hpp"
#include "reports/chart.hpp"

namespace drape {
namespace {

using html::element;
using html::Markup;

/// A band of the energy error with its upper limit. Bands go from light to dark, distinguishable without colours.
struct Band {
  double below;
  const char* color;
  const char* label;
};
constexpr std::array<Band, 6> bands{{{1e-3, "#e8f1e4", "below 0.1 %"},
                                     {1e-2, "#b9dbb4", "0.1 to 1 %"},
                                     {1e-1, "#7fb8a4", "1 to 10 %"},
                                     {0.5, "#4789a0", "10 to 50 %"},
                                     {INFINITY, "#2f5a8a", "half and more"},
                                     {INFINITY, "#9c2a20", "blown up"}}};

std::size_t band_of(const StabilityCell& cell) {
  if (cell.outcome == StabilityOutcome::blown_up) return bands.size() - 1;
  std::size_t band = 0;
  while (band + 2 < bands.size() && !(cell.energy_error < bands[band].below)) ++band;
  return band;
}

// Layout of the drawing [pixels].
constexpr double left = 62, top = 8, bottom = 46, cell_height = 13, least_width = 320;

/// Returns a width with room for a label in every decade [pixels].
double cell_width(const StabilityMap& map) {
  return std::max(20.0, least_width / static_cast<double>(map.steps.size()));
}

/// Returns the label of a row or column, one of `all`: only whole powers of ten have one.
std::string power(double value, const std::vector<double>& all) {
  const auto whole = [](double number) { return static_cast<int>(std::lround(std::log10(number))); };
  if (std::abs(std::log10(value) - whole(value)) > 1e-6) return "";
  return html::power_of_ten(whole(value), html::is_plain(whole(all.front()), whole(all.back())));
}

Markup sign(const StabilityCell& cell, double x, double y) {
  if (cell.outcome == StabilityOutcome::blown_up) {
    return element("path", {{"d", fmt::format("M{:.1f} {:.1f}l6 6m0 -6l-6 6", x - 3, y - 3)},
                            {"stroke", "#fff"},
                            {"stroke-width", "1.4"}});
  }
  if (cell.outcome != StabilityOutcome::not_converged) return {};
  return element("circle", {{"cx", html::coordinate(x)},
                            {"cy", html::coordinate(y)},
                            {"r", "2.6"},
                            {"fill", "none"},
                            {"stroke", band_of(cell) < 3 ? "#222" : "#fff"},
                            {"stroke-width", "1.2"}});
}

const char* axes_title(StabilityAxis axis) {
  constexpr const char* titles[] = {"step and stiffness of the springs", "step and stiffness of a push"};
  return titles[static_cast<std::size_t>(axis)];
}

const char* stiffness_title(StabilityAxis axis) {
  return axis == StabilityAxis::springs ? "stiffness of the springs [N/m]" : "stiffness of the push [1/s²]";
}

/// Returns true if the predicted limit of any row lies within the map.
bool is_limited(const StabilityMap& map) {
  return std::ranges::any_of(map.limits, [&](double limit) { return limit < map.steps.back(); });
}

/// Returns the position of a row's predicted limit along the step axis, in cells; NaN outside the map.
double limit_place(const StabilityMap& map, std::size_t row) {
  const auto columns = static_cast<double>(map.steps.size());
  const double per_decade = (columns - 1) / std::log10(map.steps.back() / map.steps.front());
  const double place = std::log10(map.limits[row] / map.steps.front()) * per_decade + 0.5;
  return place >= 0 && place <= columns ? place : NAN;
}

Markup limit_line(const std::string& path) {
  return element("path", {{"class", "limit under"}, {"d", path}}) + element("path", {{"class", "limit"}, {"d", path}});
}

/// Draws the predicted limit; the map's lower edge is at `below`.
Markup draw_limit(const StabilityMap& map, double below) {
  std::string path;
  for (std::size_t row = 0; row < map.stiffnesses.size(); ++row) {
    const double place = limit_place(map, row);
    if (std::isnan(place)) continue;
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", left + cell_width(map) * place,
                        below - cell_height * (static_cast<double>(row) + 0.5));
  }
  return path.empty() ? Markup() : limit_line(path);
}

Markup draw_cell(const StabilityCell& cell, double x, double y, double width) {
  const std::string says =
      fmt::format("h = {:.2g} s, stiffness {:.2g}: {}, energy error {:.2g}, {} steps not converged", cell.step,
                  cell.stiffness, outcome_name(cell.outcome), cell.energy_error, cell.not_converged);
  const Markup square = element("rect", {{"x", html::coordinate(x)},
                                         {"y", html::coordinate(y)},
                                         {"width", fmt::format("{:.1f}", width - 1)},
                                         {"height", fmt::format("{}", cell_height - 1)},
                                         {"fill", bands[band_of(cell)].color}});
  return element("g", element("title", says) + square + sign(cell, x + (width - 1) / 2, y + (cell_height - 1) / 2));
}

Markup draw_axes(const StabilityMap& map, double below) {
  Markup parts;
  for (std::size_t c = 0; c < map.steps.size(); ++c) {
    parts += html::svg_text(left + cell_width(map) * (static_cast<double>(c) + 0.5), below + 15, "middle",
                            power(map.steps[c], map.steps));
  }
  for (std::size_t r = 0; r < map.stiffnesses.size(); ++r) {
    parts += html::svg_text(left - 6, below - cell_height * (static_cast<double>(r) + 0.5) + 4, "end",
                            power(map.stiffnesses[r], map.stiffnesses));
  }
  return parts + html::svg_text(left + cell_width(map) * static_cast<double>(map.steps.size()) / 2, below + 34,
                                "middle", "step [s]");
}

/// Returns the legend entries for colours and signs.
std::vector<html::LegendEntry> cell_entries() {
  std::vector<html::LegendEntry> entries;
  const auto add = [&](const Band& band, const Markup& mark, const char* label) {
    const Markup square =
        element("rect", {{"x", "-11"}, {"y", "-6.5"}, {"width", "22"}, {"height", "13"}, {"fill", band.color}});
    entries.push_back({"cell", square + mark, label});
  };
  for (std::size_t b = 0; b + 1 < bands.size(); ++b) add(bands[b], {}, bands[b].label);
  add(bands[0], sign({.outcome = StabilityOutcome::not_converged}, 0, 0), "some steps did not converge");
  add(bands.back(), sign({.outcome = StabilityOutcome::blown_up}, 0, 0), bands.back().label);
  return entries;
}

}  // namespace

std::string map_title(const StabilityMap& map) {
  return fmt::format("{}: {}", step_method_name(map.method), axes_title(map.axis));
}

std::string map_name(const StabilityMap& map) {
  constexpr const char* axes[] = {"springs", "push"};
  return fmt::format("{}-{}", step_method_name(map.method), axes[static_cast<std::size_t>(map.axis)]);
}

html::Diagram map_diagram(const StabilityMap& map) {
  const std::size_t columns = map.steps.size();
  const double below = top + cell_height * static_cast<double>(map.stiffnesses.size());
  html::Diagram diagram;
  diagram.title = fmt::format("{}: energy error, relative to the energy exchanged, by {}.",
                              step_method_name(map.method), axes_title(map.axis));
  diagram.y_title = stiffness_title(map.axis);
  diagram.legend = cell_entries();
  if (is_limited(map)) diagram.legend.push_back({"", limit_line("M-12 0H12"), map.limit_name});
  diagram.width = left + cell_width(map) * static_cast<double>(columns) + 12;
  diagram.height = below + bottom;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const std::size_t column = i % columns, row = i / columns;
    diagram.drawing += draw_cell(map.cells[i], left + cell_width(map) * static_cast<double>(column),
                                 below - cell_height * static_cast<double>(row + 1), cell_width(map));
  }
  diagram.drawing += draw_axes(map, below) + draw_limit(map, below);
  return diagram;
}

Markup map_figure(const StabilityMap& map) {
  return element(
      "figure", {{"class", "chart"}},
      element("figcaption", map_title(map) + (is_limited(map) ? "; the dashed line: " + map.limit_name : "")) +
          element("p", {{"class", "axis-title"}}, stiffness_title(map.axis)) +
          inline_svg(map_diagram(map), {{"aria-label", map_title(map)}}) +
          html::copies({"SVG", "PNG"}, map_title(map)));
}

Markup map_legend() { return element("p", "Energy error, relative to the energy exchanged:") + legend(cell_entries()); }

std::string map_csv(const StabilityMap& map) {
  std::string table = "step,stiffness,outcome,energy_error,steps_not_converged,predicted_limit\n";
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const StabilityCell& c = map.cells[i];
    table += fmt::format("{:.6g},{:.6g},{},{:.6g},{},{:.6g}\n", c.step, c.stiffness, outcome_name(c.outcome),
                         c.energy_error, c.not_converged, map.limits[i / map.steps.size()]);
  }
  return table;
}

ResultTable map_table(const StabilityMap& map) {
  const html::Diagram diagram = map_diagram(map);
  ResultTable table{map_name(map),
                    diagram.title,
                    {diagram.y_title},
                    {},
                    {"Each column is a step. ×: the cloth blew up. *: some steps did not converge."}};
  for (const double step : map.steps) table.columns.push_back(fmt::format("{:.2g} s", step));
  for (std::size_t row = 0; row < map.stiffnesses.size(); ++row) {
    table.rows.push_back({html::short_number(map.stiffnesses[row])});
    for (std::size_t column = 0; column < map.steps.size(); ++column) {
      const StabilityCell& cell = map.cells[row * map.steps.size() + column];
      const char* const mark = cell.outcome == StabilityOutcome::not_converged ? "*" : "";
      table.rows.back().push_back(
          cell.outcome == StabilityOutcome::blown_up ? "×" : fmt::format("{:.2g}{}", cell.energy_error, mark));
    }
  }
  return table;
}

}  // namespace drape
