#include "study/stability.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/simulation.hpp"
#include "reports/chart.hpp"
#include "study/report.hpp"

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

std::string name_of(const EnergyCurve& curve) {
  return fmt::format("{}, h = {:g} s", step_method_name(curve.method), curve.step);
}

NamedChart energy_chart(const std::vector<EnergyCurve>& curves) {
  html::Chart chart{"Energy of a cloth that swings without damping, relative to the energy exchanged with gravity.",
                    "time [s]",
                    "energy gained, relative to energy exchanged",
                    html::Scale::linear,
                    html::Scale::linear,
                    {},
                    {}};
  for (const EnergyCurve& curve : curves) {
    html::ChartSeries series = method_series(step_method_name(curve.method));
    series.name = name_of(curve);
    series.markers = false;
    // Colours show the scheme here; the long step is dashed.
    if (curve.method.scheme == TimeScheme::sdirk2) series.style = 5;
    series.other = curve.step > 0.01;
    for (std::size_t i = 0; i < curve.times.size(); ++i) {
      series.points.push_back({curve.times[i],
                               curve.energies[i],
                               fmt::format("{:.1f} s: {:.2g}", curve.times[i], curve.energies[i]),
                               {},
                               {}});
    }
    chart.series.push_back(std::move(series));
  }
  return {"energy-over-time", std::move(chart)};
}

/// Returns a sentence about the energy left at the end.
std::string describe_energies(const std::vector<EnergyCurve>& curves) {
  std::string text = "After eight seconds ";
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const double end = curves[i].energies.back();
    text += fmt::format("{}{} has {} {:.2g} % of the energy exchanged with gravity", i == 0 ? "" : ", ",
                        name_of(curves[i]), end < 0 ? "lost" : "gained", 100 * std::abs(end));
  }
  return text + ".";
}

constexpr double stiffness = 100;  // stiffness of the springs [N/m]
constexpr double below = 0.95, beyond = 1.2;
constexpr int limit_steps = 99;  // few enough to make every state a frame
constexpr double far_away = 3;   // in cloth sizes

StudyMotion limit_motion(double factor) {
  const double safe = stability_limit(Method::semi_implicit, StabilityAxis::springs, stiffness);
  Scene scene;
  scene.name = "stability";
  scene.simulation = stability_cloth(Method::semi_implicit, StabilityAxis::springs, factor * safe, stiffness);
  scene.look.mesh_lines = true;
  scene.camera = {.azimuth = Camera::usual_azimuth, .elevation = Camera::usual_elevation};  // the same for both motions
  const Vertices& at_first = scene.simulation.cloth.positions;
  const double size = (at_first.colwise().maxCoeff() - at_first.colwise().minCoeff()).norm();
  StudyMotionRecorder recorder(scene);
  Simulation simulation(scene.simulation);
  recorder.add(simulation);
  try {
    for (int step = 0; step < limit_steps; ++step) {
      simulation.step();
      recorder.add(simulation);
      if (!((simulation.state().x - at_first).cwiseAbs().maxCoeff() < far_away * size)) break;
    }
  } catch (const DivergedError&) {
    if (simulation.state().x.allFinite()) recorder.add(simulation);  // the last finite state
  }
  return {fmt::format("semi-implicit, {} of the safe step", factor), {}, recorder.finish()};
}

/// Describes limit_motions() in a sentence.
std::string describe_limit_motions() {
  return fmt::format(
      "Two motions of that cloth with springs of {:g} N/m, by semi-implicit Euler: with {:g} of the safe step it "
      "swings, with {:g} of it the fastest oscillation grows in every step until the motion blows up.",
      stiffness, below, beyond);
}

}  // namespace

std::vector<StudyMotion> limit_motions() { return {limit_motion(below), limit_motion(beyond)}; }

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
