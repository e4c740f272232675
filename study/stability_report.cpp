#include "study/stability_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/atomic_file.hpp"
#include "html/components.hpp"
#include "html/page.hpp"
#include "study/stability_map.hpp"

namespace drape {
namespace {

/// How many cells of the map ended in which way.
std::string tally(const StabilityMap& map) {
  std::array<int, 4> counts{};
  for (const StabilityCell& cell : map.cells) ++counts[static_cast<std::size_t>(cell.outcome)];
  std::string text;
  for (const StabilityOutcome outcome : {StabilityOutcome::stable, StabilityOutcome::converged,
                                         StabilityOutcome::not_converged, StabilityOutcome::blown_up}) {
    const int count = counts[static_cast<std::size_t>(outcome)];
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, outcome_name(outcome));
  }
  return text;
}

std::pair<double, double> ratios(const StabilityStudy& study) {
  double lowest = 1e300, highest = 0;
  for (const StabilityBorder& border : study.borders) {
    lowest = std::min(lowest, border.measured / border.predicted);
    highest = std::max(highest, border.measured / border.predicted);
  }
  return {lowest, highest};
}

std::string headline(const StabilityStudy& study) {
  const auto [lowest, highest] = ratios(study);
  return fmt::format("Semi-implicit Euler becomes unstable at {:.2f} to {:.2f} times its predicted step", lowest,
                     highest);
}

}  // namespace

ResultTable border_table(const StabilityStudy& study) {
  ResultTable table{
      .name = "border",
      .title = "Where semi-implicit Euler becomes unstable",
      .columns = {"k [N/m]", "predicted [s]", "measured [s]", "measured/predicted"},
      .rows = {},
      .notes = {"Predicted: 2/√λ of the stiffest that the springs can be in any state. Measured: the longest "
                "step with which 2000 steps do not blow up."}};
  for (const StabilityBorder& b : study.borders) {
    table.rows.push_back({fmt::format("{:g}", b.stiffness), fmt::format("{:.4g}", b.predicted),
                          fmt::format("{:.4g}", b.measured), fmt::format("{:.3f}", b.measured / b.predicted)});
  }
  return table;
}

std::string stability_text(const StabilityStudy& study) {
  std::string text = to_text(border_table(study)) + "\n";
  for (const StabilityMap& map : study.maps) text += fmt::format("{}: {}\n", map_title(map), tally(map));
  return text;
}

std::string stability_page(const StabilityStudy& study) {
  html::Markup maps;
  for (const StabilityAxis axis :
       {StabilityAxis::springs, StabilityAxis::explicit_push, StabilityAxis::implicit_push}) {
    std::vector<html::Markup> row;
    for (const StabilityMap& map : study.maps) {
      if (map.axis == axis) row.push_back(map_svg(map));
    }
    maps += html::row(row);
  }
  std::vector<html::Finding> findings;
  for (const StabilityMap& map : study.maps)
    findings.push_back({html::Tone::neutral, html::element("strong", map_title(map)) + ". " + tally(map) + "."});
  html::Page page;
  page.kind = "drape study stability";
  page.title = "How far each method goes";
  page.heading = headline(study);
  page.introduction =
      html::paragraph(fmt::format(
          "A cloth of 6×6 cells and 1 kg hangs from two corners under gravity, above a sphere in the lower maps. Every "
          "square is a run of {} steps. Its colour says how much of the energy that moved was lost or gained.",
          study.steps)) +
      html::command("This study", "drape study stability");
  page.content = html::section(2, "maps", "Maps", map_legend() + maps) +
                 html::section(2, "border", "The border of semi-implicit Euler", to_html(border_table(study))) +
                 html::section(2, "counts", "In figures", html::findings(findings));
  page.foot = html::provenance();
  page.foot.emplace_back("Took", fmt::format("{:.0f} s", study.seconds));
  return html::render(page);
}

std::string write_stability_files(const StabilityStudy& study, const std::filesystem::path& folder) {
  write_file_atomically(folder / "border.csv", to_csv(border_table(study)));
  write_file_atomically(folder / "report.html", stability_page(study));
  std::string problem;
  for (const StabilityMap& map : study.maps) {
    const std::string missing = write_map(map, folder);
    if (problem.empty()) problem = missing;
  }
  return problem;
}

}  // namespace drape
