#include "study/stability_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/atomic_file.hpp"
#include "study/gnuplot.hpp"

namespace drape {
namespace {

using html::element;
using html::Markup;

/// The bands of the energy error, each up to a limit. From light to dark, told apart also without colours.
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

// Of the drawing [pixels].
constexpr double left = 62, top = 8, bottom = 46, cell_width = 20, cell_height = 13;

Markup text(double x, double y, const char* anchor, const std::string& label) {
  return element("text", {{"x", fmt::format("{:.1f}", x)}, {"y", fmt::format("{:.1f}", y)}, {"text-anchor", anchor}},
                 label);
}

std::string power(double value) {
  const double exponent = std::log10(value);
  return std::abs(exponent - std::round(exponent)) < 1e-6 ? fmt::format("1e{:.0f}", exponent) : "";
}

Markup sign(const StabilityCell& cell, double x, double y) {
  if (cell.outcome == StabilityOutcome::blown_up) {
    return element(
        "path",
        {{"d", fmt::format("M{0} {1}l6 6m0 -6l-6 6", x - 3, y - 3)}, {"stroke", "#fff"}, {"stroke-width", "1.4"}});
  }
  if (cell.outcome != StabilityOutcome::not_converged) return {};
  return element("circle", {{"cx", fmt::format("{}", x)},
                            {"cy", fmt::format("{}", y)},
                            {"r", "2.6"},
                            {"fill", "none"},
                            {"stroke", band_of(cell) < 3 ? "#222" : "#fff"},
                            {"stroke-width", "1.2"}});
}

const char* stiffness_title(StabilityAxis axis) {
  return axis == StabilityAxis::springs ? "stiffness of the springs, N/m" : "stiffness of the push, 1/s²";
}

/// Whether the predicted limit lies within the map anywhere.
bool is_limited(const StabilityMap& map) {
  return std::ranges::any_of(map.limits, [&](double limit) { return limit < map.steps.back(); });
}

/// Half the way from a cell to the next, as a factor.
double half_way(const std::vector<double>& axis) { return std::sqrt(axis[1] / axis[0]); }

/// Of a gnuplot script, all but what draws.
std::string plot_settings(const StabilityMap& map) {
  std::string palette;
  for (std::size_t b = 0; b < bands.size(); ++b) {
    palette += fmt::format("{}{} '{}'", b == 0 ? "" : ", ", b, bands[b].color);
  }
  const double x_half = half_way(map.steps), y_half = half_way(map.stiffnesses);
  return fmt::format(
             "# gnuplot {0}.gp draws {0}.svg and {0}.png from {0}.csv.\n"
             "set datafile separator ','\nset encoding utf8\nset title \"{1}\" noenhanced\n"
             "set xlabel 'step, s' offset 0,0.3\nset ylabel '{2}'\nset logscale xy\nset format '10^{{%L}}'\n"
             "set key outside below\nset bmargin 4.5\nset rmargin 11\nset tics out nomirror\n",
             map_name(map), map_title(map), stiffness_title(map.axis)) +
         fmt::format("set xrange [{:.4g}:{:.4g}]\nset yrange [{:.4g}:{:.4g}]\n", map.steps.front() / x_half,
                     map.steps.back() * x_half, map.stiffnesses.front() / y_half, map.stiffnesses.back() * y_half) +
         fmt::format(
             "set palette maxcolors {} defined ({})\nset cbrange [-0.5:{}.5]\nset cblabel 'error of the energy'\n"
             "set cbtics ('< 0.1 %%' 0, '< 1 %%' 1, '< 10 %%' 2, '< 50 %%' 3, '≥ 50 %%' 4, 'blown up' 5) scale 0\n",
             bands.size(), palette, bands.size() - 1);
}

/// Of a gnuplot script, what draws: the cells, a ring where steps did not converge, and the predicted limit.
std::string plot_command(const StabilityMap& map) {
  const std::string data = fmt::format("'{}.csv' skip 1", map_name(map));
  constexpr double gap = 0.96;
  std::string plot = fmt::format(
      "plot {0} using 1:2:($1/{1:.4f}):($1*{1:.4f}):($2/{2:.4f}):($2*{2:.4f}):7 with boxxyerror fs solid noborder lc "
      "palette notitle",
      data, gap * half_way(map.steps), gap * half_way(map.stiffnesses));
  const auto rings = [&](const char* bands_of_them, const char* color, const char* title) {
    plot += fmt::format(
        ", \\\n     {} using 1:(strcol(3) eq 'not converged' && $7 {} ? $2 : 1/0) with points pt 6 ps 0.9 lw 1.8 lc "
        "rgb "
        "'{}' {}",
        data, bands_of_them, color, title);
  };
  if (std::ranges::any_of(map.cells, [](const StabilityCell& c) { return c.not_converged > 0; })) {
    rings("< 3", "#222222", "title 'some steps did not converge'");
    rings(">= 3", "#ffffff", "notitle");
  }
  if (is_limited(map)) {
    plot +=
        fmt::format(", \\\n     {} using 6:2 with lines lw 2.5 dt 2 lc rgb 'black' title '{}'", data, map.limit_name);
  }
  return plot;
}

}  // namespace

std::string map_title(const StabilityMap& map) {
  constexpr const char* axes[] = {"step and stiffness of the springs", "step and stiffness of a ground's explicit push",
                                  "step and stiffness of a ground's implicit push"};
  return fmt::format("{}: {}", method_name(map.method), axes[static_cast<std::size_t>(map.axis)]);
}

std::string map_name(const StabilityMap& map) {
  constexpr const char* axes[] = {"springs", "explicit-push", "implicit-push"};
  return fmt::format("{}-{}", method_name(map.method), axes[static_cast<std::size_t>(map.axis)]);
}

Markup map_svg(const StabilityMap& map) {
  const std::size_t columns = map.steps.size(), rows = map.stiffnesses.size();
  const double width = left + cell_width * static_cast<double>(columns) + 12;
  const double below = top + cell_height * static_cast<double>(rows);
  Markup drawing;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const StabilityCell& cell = map.cells[i];
    const double x = left + cell_width * static_cast<double>(i % columns);
    const double y = below - cell_height * static_cast<double>(i / columns + 1);
    const std::string says =
        fmt::format("h = {:.2g} s, stiffness {:.2g}: {}, energy error {:.2g}, {} steps not converged", cell.step,
                    cell.stiffness, outcome_name(cell.outcome), cell.energy_error, cell.not_converged);
    drawing += element("g", {},
                       element("title", says) +
                           element("rect", {{"x", fmt::format("{}", x)},
                                            {"y", fmt::format("{}", y)},
                                            {"width", fmt::format("{}", cell_width - 1)},
                                            {"height", fmt::format("{}", cell_height - 1)},
                                            {"fill", bands[band_of(cell)].color}}) +
                           sign(cell, x + cell_width / 2 - 0.5, y + cell_height / 2 - 0.5));
  }
  for (std::size_t c = 0; c < columns; ++c) {
    drawing += text(left + cell_width * (static_cast<double>(c) + 0.5), below + 15, "middle", power(map.steps[c]));
  }
  for (std::size_t r = 0; r < rows; ++r) {
    drawing +=
        text(left - 6, below - cell_height * (static_cast<double>(r) + 0.5) + 4, "end", power(map.stiffnesses[r]));
  }
  drawing += text(left + cell_width * static_cast<double>(columns) / 2, below + 34, "middle", "step, s");
  const double per_decade = static_cast<double>(columns - 1) / std::log10(map.steps.back() / map.steps.front());
  std::string path;
  for (std::size_t r = 0; r < rows; ++r) {
    const double place = std::log10(map.limits[r] / map.steps.front()) * per_decade + 0.5;
    if (!std::isfinite(place) || place < 0 || place > static_cast<double>(columns)) continue;
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", left + cell_width * place,
                        below - cell_height * (static_cast<double>(r) + 0.5));
  }
  drawing += element(
      "path", {{"d", path}, {"fill", "none"}, {"stroke", "#000"}, {"stroke-width", "2"}, {"stroke-dasharray", "6 3"}});
  const Markup svg = element(
      "svg",
      {{"viewBox", fmt::format("0 0 {} {}", width, below + bottom)}, {"role", "img"}, {"aria-label", map_title(map)}},
      drawing);
  return element(
      "figure", {{"class", "chart"}},
      element("figcaption", map_title(map) + (is_limited(map) ? "; the dashed line: " + map.limit_name : "")) +
          element("p", {{"class", "axis-title"}}, stiffness_title(map.axis)) + svg);
}

Markup map_legend() {
  Markup entries;
  const auto entry = [&](const char* color, const Markup& mark, const char* label) {
    entries += element("li", element("svg", {{"class", "key"}, {"viewBox", "0 0 24 14"}, {"aria-hidden", "true"}},
                                     element("rect", {{"width", "22"}, {"height", "13"}, {"fill", color}}) + mark) +
                                 label);
  };
  for (std::size_t b = 0; b + 1 < bands.size(); ++b) entry(bands[b].color, {}, bands[b].label);
  entry(bands[0].color, sign({.outcome = StabilityOutcome::not_converged}, 11, 6.5), "some steps did not converge");
  entry(bands.back().color, sign({.outcome = StabilityOutcome::blown_up}, 11, 6.5), "blown up");
  return element("p", {}, "Error of the energy, of what moved:") + element("ul", {{"class", "legend"}}, entries);
}

std::string map_csv(const StabilityMap& map) {
  std::string table = "step,stiffness,outcome,energy_error,steps_not_converged,predicted_limit,band\n";
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const StabilityCell& c = map.cells[i];
    table += fmt::format("{:.6g},{:.6g},{},{:.6g},{},{:.6g},{}\n", c.step, c.stiffness, outcome_name(c.outcome),
                         c.energy_error, c.not_converged, map.limits[i / map.steps.size()], band_of(c));
  }
  return table;
}

std::string write_map(const StabilityMap& map, const std::filesystem::path& folder) {
  const std::string name = map_name(map);
  write_file_atomically(folder / (name + ".csv"), map_csv(map));
  const std::string plot = plot_command(map);
  write_file_atomically(
      folder / (name + ".gp"),
      plot_settings(map) +
          fmt::format("set terminal svg size 800,640 font 'DejaVu Sans,13'\nset output '{0}.svg'\n{1}\n"
                      "set terminal pngcairo size 1200,960 font 'DejaVu Sans,18'\nset output "
                      "'{0}.png'\n{1}\n",
                      name, plot));
  return draw_with_gnuplot(folder, name);
}

}  // namespace drape
