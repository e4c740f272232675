#include "compare/page.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <set>

#include "core/text.hpp"
#include "reports/chart.hpp"
#include "reports/components.hpp"
#include "reports/page.hpp"
#include "reports/players.hpp"

namespace drape {
namespace {

using html::Markup;

/// Formats the time of a frame [s].
std::string time_of(const CompareResult& result, double time) {
  return readable_time(time, result.times.size() < 2 ? 1 : result.times[1] - result.times[0]);
}

Markup films(const CompareResult& result, const std::vector<PageMoment>& moments, std::size_t poster,
             const std::string& bar) {
  std::vector<std::string> names;
  for (const ComparedMotion& motion : result.motions) names.push_back(motion.label);
  std::vector<html::FilmMoment> shown;
  for (const PageMoment& moment : moments) shown.push_back({"t = " + time_of(result, moment.time), moment.pictures});
  Markup content = html::film("film", names, shown, poster);
  if (!bar.empty()) content += html::figure(html::picture("image/png", bar, "What the colours mean"), {});
  return html::section(2, "motions", "The motions side by side", content);
}

Markup differences_table(const CompareResult& result) {
  if (!result.keys_known) {
    return html::paragraph("A motion of another program has no scene, so the scenes were not compared.");
  }
  if (result.differences.empty()) return html::paragraph("The scenes are the same.");
  html::Table table{"Keys that differ", {{"key"}}, {}};
  for (const ComparedMotion& motion : result.motions) table.columns.push_back({motion.label});
  for (const KeyDifference& difference : result.differences) {
    std::vector<Markup> cells{html::code(difference.key)};
    for (const std::string& value : difference.values) cells.emplace_back(value);
    table.rows.push_back(std::move(cells));
  }
  return html::table(table);
}

/// Returns the largest value over all frames; nothing if there is none.
std::optional<double> largest(const std::vector<std::optional<double>>& values) {
  std::optional<double> most;
  for (const auto& value : values) {
    if (value && (!most || *value > *most)) most = value;
  }
  return most;
}

Markup figures_table(const CompareResult& result) {
  html::Table table{"Figures of the motions",
                    {{"motion"},
                     {"steps", true},
                     {"iterations per step", true},
                     {"µs per step", true},
                     {"energy at the end [J]", true},
                     {"largest distance from the first", true},
                     {"mean distance at the end", true}},
                    {}};
  for (const ComparedMotion& motion : result.motions) {
    const Statistics& s = motion.statistics;
    const bool first = &motion == &result.motions.front(), known = s.steps() > 0;
    const std::optional<double>& energy = motion.total_energy.back();
    const auto length = [&](const std::optional<double>& metres) -> Markup {
      return first || !metres ? "–" : readable_length(*metres);
    };
    table.rows.push_back({motion.label, known ? fmt::format("{}", s.steps()) : "–",
                          known && s.mean_iterations() > 0 ? fmt::format("{:.2f}", s.mean_iterations()) : "–",
                          s.median_microseconds() > 0 ? fmt::format("{:.1f}", s.median_microseconds()) : "–",
                          energy ? fmt::format("{:.4g}", *energy) : "–", length(largest(motion.most)),
                          length(motion.mean.back())});
  }
  return html::table(table) + html::note(
                                  "Times are medians of one run of all motions at once; measure them properly with "
                                  "drape study. A motion that was "
                                  "read from a file has none.");
}

/// Returns an empty series for the i-th motion, in its method's colour if the methods tell all motions apart.
html::ChartSeries series_of(const CompareResult& result, std::size_t i) {
  std::set<std::string> methods;
  for (const ComparedMotion& motion : result.motions) methods.insert(motion.method);
  html::ChartSeries series;
  if (methods.size() == result.motions.size()) {
    series = method_series(result.motions[i].method);
  } else {
    series.style = i;
  }
  series.name = result.motions[i].label;
  series.markers = false;
  return series;
}

/// Plots a quantity over time, a line per motion.
/// @param of returns a motion's value at a frame
template <class Of>
NamedChart lines(const CompareResult& result, const std::string& name, const std::string& title,
                 const std::string& y_title, Of of) {
  html::Chart chart{.title = title, .x_title = "time [s]", .y_title = y_title, .series = {}, .levels = {}};
  const std::size_t every = std::max<std::size_t>(1, result.times.size() / 200);
  for (std::size_t i = 0; i < result.motions.size(); ++i) {
    html::ChartSeries series = series_of(result, i);
    for (std::size_t k = 0; k < result.times.size(); k += every) {
      const std::optional<double> y = of(result.motions[i], k);
      if (!y) continue;
      const double time = result.times[k];
      series.points.push_back({time, *y, fmt::format("{}: {:.4g}", time_of(result, time), *y), {}});
    }
    if (!series.points.empty()) chart.series.push_back(std::move(series));
  }
  return {name, std::move(chart)};
}

/// Returns a player for each motion; one opens at a time.
Markup players(const CompareResult& result) {
  Markup content;
  for (std::size_t i = 0; i < result.motions.size(); ++i) {
    const ComparedMotion& motion = result.motions[i];
    if (motion.played.frames == 0) continue;
    content +=
        html::details(motion.label, html::motion_player(fmt::format("motion-{}", i), motion.played, motion.label) +
                                        html::note(describe(motion.played)));
  }
  return content.empty() ? content : html::section(2, "turn", "Turn the cloth", content);
}

Markup curves(const CompareResult& result) {
  Markup content;
  for (const NamedChart& diagram : comparison_charts(result)) content += html::chart(diagram.chart);
  return content;
}

}  // namespace

std::vector<NamedChart> comparison_charts(const CompareResult& result) {
  std::vector<NamedChart> charts{
      lines(result, "energy", "Total energy over time", "total energy [J]",
            [](const ComparedMotion& m, std::size_t k) { return m.total_energy[k]; }),
      lines(result, "distance", "Mean distance of the vertices from those of the first motion", "mean distance [m]",
            [&](const ComparedMotion& m, std::size_t k) {
              return &m == &result.motions.front() ? std::nullopt : m.mean[k];
            })};
  std::erase_if(charts, [](const NamedChart& diagram) { return diagram.chart.series.empty(); });
  return charts;
}

namespace {

/// Returns the answer in one sentence: the motion that is furthest from the first, if the distances are known.
std::string headline(const CompareResult& result) {
  const ComparedMotion* furthest = nullptr;
  bool known = true;
  for (const ComparedMotion& motion : result.motions) {
    if (&motion == &result.motions.front()) continue;
    const std::optional<double> most = largest(motion.most);
    known = known && most;
    if (most && (furthest == nullptr || *most > *largest(furthest->most))) furthest = &motion;
  }
  const std::string& first = result.motions.front().label;
  const double most = furthest == nullptr ? 0 : *largest(furthest->most);
  if (most > 0) return fmt::format("{} is up to {} from {}", furthest->label, readable_length(most), first);
  return known ? fmt::format("All {} motions are the same", result.motions.size())
               : fmt::format("{} motions side by side", result.motions.size());
}

}  // namespace

std::string comparison_page(const CompareResult& result, const std::vector<PageMoment>& moments, std::size_t poster,
                            const std::string& bar, const std::string& command) {
  std::vector<html::Finding> found;
  for (const ComparedMotion& motion : result.motions) {
    if (!motion.divergence.empty()) found.push_back({html::Tone::bad, motion.label + ": " + motion.divergence});
    if (!motion.matched.empty()) found.push_back({html::Tone::neutral, motion.label + ": " + motion.matched});
    const std::optional<double> most = largest(motion.most);
    if (&motion != &result.motions.front() && most) {
      found.push_back(
          {html::Tone::neutral, fmt::format("{}: at most {} from the first, {} on average at the end", motion.label,
                                            readable_length(*most), readable_length(motion.mean.back().value_or(0)))});
    }
  }
  html::Page page;
  page.title = "drape compare";
  page.kind = "drape compare";
  page.heading = headline(result);
  page.introduction = html::findings(found) + html::command("Run this comparison again", command);
  page.content = films(result, moments, poster, bar) + players(result) +
                 html::section(2, "figures", "Figures", figures_table(result)) +
                 html::section(2, "differences", "Differences", differences_table(result)) +
                 html::section(2, "curves", "Over time", curves(result));
  for (const auto& [name, value] : html::provenance()) page.foot.emplace_back(name, value);
  return html::render(page);
}

}  // namespace drape
