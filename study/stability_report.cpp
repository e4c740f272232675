#include "study/stability_report.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>

#include "drape/scene/scene.hpp"
#include "study/stability.hpp"

namespace drape {
namespace {

/// Counts the cells of a map by outcome.
std::string tally(const StabilityMap& map) {
  std::array<int, 4> counts{};
  for (const StabilityCell& cell : map.cells) ++counts[static_cast<std::size_t>(cell.outcome)];
  std::string text;
  for (const StabilityOutcome outcome : {StabilityOutcome::stable, StabilityOutcome::converged,
                                         StabilityOutcome::not_converged, StabilityOutcome::blown_up}) {
    const int count = counts[static_cast<std::size_t>(outcome)];
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, outcome_name(outcome));
  }
  return text + ".";
}

/// Returns measured over predicted.
double ratio(const StabilityLimit& border) { return border.measured / border.predicted; }

ResultTable border_table(const std::vector<StabilityLimit>& borders) {
  ResultTable table{
      .name = "border",
      .title = "Where a method becomes unstable",
      .columns = {"method", "stiff part", "stiffness", "predicted [s]", "measured [s]", "measured/predicted"},
      .rows = {},
      .notes = {"Predicted: for explicit methods 2/√λ, with springs and pushes together at their stiffest; otherwise "
                "2/√stiffness of the push. Measured: the longest step with which 2000 steps do not blow up."}};
  for (const StabilityLimit& b : borders) {
    const bool springs = b.axis == StabilityAxis::springs;
    table.rows.push_back({step_method_name(b.method), springs ? "springs" : "push",
                          fmt::format("{:g} {}", b.stiffness, springs ? "N/m" : "1/s²"),
                          fmt::format("{:.4g}", b.predicted), fmt::format("{:.4g}", b.measured),
                          fmt::format("{:.3f}", ratio(b))});
  }
  return table;
}

std::string headline(const std::vector<StabilityLimit>& borders) {
  const auto [lowest, highest] = std::minmax_element(borders.begin(), borders.end(),
                                                     [](const auto& a, const auto& b) { return ratio(a) < ratio(b); });
  return fmt::format("Instability sets in at {:.2f} to {:.2f} times the predicted step", ratio(*lowest),
                     ratio(*highest));
}

StudySection section(const StabilityStudy& study, StabilityAxis axis, const char* title, const char* cloth) {
  StudySection section;
  section.title = title;
  section.text = {cloth};
  for (const StabilityMap& map : study.maps) {
    if (map.axis == axis) section.maps.push_back(map);
  }
  return section;
}

}  // namespace

StudyReport stability_report(const StabilityStudy& study) {
  StudyReport report;
  report.kind = "drape study stability";
  report.title = "Stability of each method";
  report.headline = headline(study.borders);
  report.introduction = fmt::format(
      "Each square is a run of {} steps of a cloth of 6×6 cells and 1 kg. Its colour shows the energy lost or gained, "
      "relative to the energy exchanged.",
      study.detail.steps);
  report.command =
      fmt::format("drape study stability --per-decade {} --steps {}", study.detail.per_decade, study.detail.steps);
  for (const StabilityMap& map : study.maps) {
    report.findings.push_back({html::Tone::neutral, "", map_title(map) + ".", tally(map)});
  }
  constexpr const char* hangs = "The cloth hangs from two corners under gravity.";
  constexpr const char* lies =
      "The cloth, with springs of 180 N/m, rests 1 cm deep in a level ground under an acceleration that the push just "
      "balances, and oscillates by 0.1 mm.";
  report.sections = {section(study, StabilityAxis::springs, "Springs", hangs),
                     {.title = "Below and beyond the limit",
                      .text = {describe_limit_motions()},
                      .tables = {},
                      .charts = {},
                      .pictures = {},
                      .motions = limit_motions()},
                     section(study, StabilityAxis::push, "Push of a sphere, evaluated once per step", lies),
                     {"Limits of stability", {}, {border_table(study.borders)}, {}, {}},
                     {"Energy over time", {describe_energies(study.energies)}, {}, {energy_chart(study.energies)}, {}}};
  report.seconds = study.seconds;
  return report;
}

}  // namespace drape
