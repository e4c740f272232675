#include "study/accuracy_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/method_names.hpp"
#include "study/accuracy_asked.hpp"
#include "study/accuracy_charts.hpp"
#include "study/accuracy_cheapest.hpp"
#include "study/accuracy_summary.hpp"
#include "study/profile.hpp"

namespace drape {
namespace {

std::string figure(double value) { return std::isfinite(value) ? fmt::format("{:.3g}", value) : "–"; }

ResultTable tolerance_table(const SceneAccuracy& scene) {
  ResultTable table{scene.name + "-tolerances",
                    fmt::format("{}: methods and tolerances, h = {:g} s", scene.scene, scene.step),
                    {"method", fmt::format("ε [{}]", scene.tolerance_unit), "iterations", "capped steps", "µs per step",
                     "from", "to", "runs", "set-up [µs]", "solve: max [m]", "RMS [m]", "‖∇g‖, relative"},
                    {},
                    {"Set-up is the work before the first step, mainly the factorisation of the constant matrix."}};
  for (const double time : scene.options.times) table.columns.push_back(fmt::format("motion at {:g} s [m]", time));
  table.columns.emplace_back("flipped pairs");
  table.notes.emplace_back(
      "Flipped pairs: neighbouring triangles whose normals are more than 150° apart, averaged over all steps. Times "
      "and iterations are averages up to the last compared time.");
  table.notes.emplace_back(interval_note);
  for (const TolerancePoint& p : scene.points) {
    const MedianInterval time = p.measured.time();
    table.rows.push_back({step_method_name(p.method), plain_number(p.tolerance),
                          fmt::format("{:.2f}", p.measured.iterations), fmt::format("{}", p.measured.capped),
                          three_digits(time.median), three_digits(time.lower), three_digits(time.upper),
                          fmt::format("{}", time.count), three_digits(median_interval(p.measured.setup).median),
                          figure(p.solve.max), figure(p.solve.rms), figure(p.solve.gradient)});
    for (const Distance& d : p.motion) table.rows.back().push_back(figure(d.max));
    table.rows.back().push_back(fmt::format("{:.2f}", p.measured.flipped_pairs));
  }
  return table;
}

ResultTable step_table(const SceneAccuracy& scene) {
  ResultTable table{
      scene.name + "-steps",
      fmt::format("{}: time steps, error at {:g} s", scene.scene, scene.options.times.front()),
      {"method", "h [s]", "iterations", "µs per step", "ms per second of motion", "from", "to", "runs",
       "error: max [m]", "RMS [m]", "order"},
      {},
      {fmt::format("Order: relative to the preceding step length. The reference is extrapolated from h = {:g} s and "
                   "twice that, which changes it by {:.2g} m; from twice these it is {:.2g} m away.",
                   scene.step_reference, scene.step_gained.front(), scene.step_apart),
       interval_note}};
  for (const StepPoint& p : scene.steps) {
    const MedianInterval motion = p.measured.cost();
    const bool iterates = !is_explicit(p.method.method);
    table.rows.push_back({step_method_name(p.method), plain_number(p.step),
                          iterates ? fmt::format("{:.2f}", p.measured.iterations) : "–",
                          three_digits(p.measured.time().median), three_digits(motion.median),
                          three_digits(motion.lower), three_digits(motion.upper), fmt::format("{}", motion.count),
                          figure(p.error.max), figure(p.error.rms),
                          std::isfinite(p.order) ? fmt::format("{:.2f}", p.order) : "–"});
  }
  return table;
}

/// Returns "semi-implicit 0.99, implicit 0.87 (from h = 0.00125 s to 0.000625 s)".
std::string describe_orders(const SceneAccuracy& scene) {
  std::string text, unknown;
  for (const StepMethod method : scene.options.methods) {
    const auto last = std::find_if(scene.steps.rbegin(), scene.steps.rend(),
                                   [method](const StepPoint& p) { return p.method == method; });
    if (last == scene.steps.rend() || !std::isfinite(last->order)) continue;
    if (last->error.max < scene.step_gained.front()) {
      unknown += fmt::format(" The errors of {} are below the uncertainty of the reference.", step_method_name(method));
      continue;
    }
    text += fmt::format("{}{} {:.2f}", text.empty() ? "" : ", ", step_method_name(method), last->order);
  }
  return text.empty() ? text : text + ", each between the two smallest steps." + unknown;
}

void add_findings(StudyReport& report, const SceneAccuracy& scene) {
  if (!scene.points.empty()) {
    report.findings.push_back(
        {html::Tone::neutral, "", fmt::format("{}: solve error.", scene.scene), describe_cheapest(scene)});
    const std::string confirmed = fmt::format(
        "From the same state, Newton's method and quasi-Newton end at most {:.2g} m apart, over {} states{}.",
        scene.solve_apart, scene.states,
        scene.left_out > 0
            ? fmt::format(" ({} more are so close to buckling that the minimiser is uncertain by more than 1 µm)",
                          scene.left_out)
            : "");
    report.findings.push_back({scene.solve_apart < smallest_error ? html::Tone::good : html::Tone::caution, "",
                               fmt::format("{}: reference.", scene.scene), confirmed});
    report.findings.push_back(
        {scene.chaotic_from ? html::Tone::caution : html::Tone::good, "",
         scene.chaotic_from ? fmt::format("{}: the motion is chaotic from {:g} s.", scene.scene, *scene.chaotic_from)
                            : fmt::format("{}: the motion is not chaotic up to its end.", scene.scene),
         fmt::format("The two reference motions, which differ only by rounding, {} 1 µm; at {:g} s they are {:.2g} m "
                     "apart.",
                     scene.chaotic_from ? "diverge by more than" : "stay within", scene.options.times.back(),
                     scene.apart.back())});
  }
  if (const std::string orders = describe_orders(scene); !orders.empty()) {
    report.findings.push_back(
        {html::Tone::neutral, "", fmt::format("{}: orders of convergence in the time step.", scene.scene), orders});
  }
}

std::string headline(const std::vector<SceneAccuracy>& scenes) {
  double least = INFINITY, most = 0;
  for (const SceneAccuracy& scene : scenes) {
    if (scene.points.empty()) continue;
    const std::vector<Offer> offers = solve_offers(scene);
    const Cheapest c = find_cheapest(offers, smallest_error);
    if (c.first == nullptr) continue;
    least = std::min(least, c.first->cost.median);
    most = std::max(most, c.first->cost.median);
  }
  if (!(most > 0)) return "What accuracy costs";
  if (least == most) return fmt::format("A step solved to 1 µm costs {} µs", three_digits(most));
  return fmt::format("A step solved to 1 µm costs {} to {} µs", three_digits(least), three_digits(most));
}

/// Returns the section for a reader with a scene to compute: the pictures, and a method for each error.
StudySection answer_section(const AccuracyStudy& study) {
  StudySection answer{
      "What to take",
      {"Choose the kind of error that matters to you, and how large it may be: there stand the cheapest "
       "method, its setting and its cost. The evidence follows.",
       "Whole: the distance from the true motion. Its three parts are told apart below. Solve: how far "
       "one step is from its exact result. Motion: what these errors have accumulated to. Time step: "
       "what even exact steps leave, because they are not small."},
      {},
      {},
      {}};
  for (std::size_t i = 0; i < study.scenes.size(); ++i) {
    answer.pictures.insert(answer.pictures.end(), study.pictures[i].begin(), study.pictures[i].end());
    answer.tables.push_back(answer_table(study.scenes[i]));
  }
  return answer;
}

}  // namespace

StudyReport accuracy_report(const AccuracyStudy& study) {
  const std::vector<SceneAccuracy>& scenes = study.scenes;
  StudyReport report;
  report.kind = "drape study accuracy";
  report.title = "What accuracy costs in time";
  report.headline = headline(scenes);
  report.introduction =
      "Error against computing time: of a step relative to the exact minimiser, and of a motion relative to the "
      "reference motion. Each point is a method with a tolerance, a time step or a requested accuracy. Lower and "
      "further left is better.";
  report.command = study.command;
  report.seconds = study.seconds;
  report.provenance = study.provenance;
  report.answer = answer_section(study);
  if (auto summary = asked_summary(scenes)) report.sections.push_back(std::move(*summary));
  if (auto summary = solve_summary(scenes)) report.sections.push_back(std::move(*summary));
  if (auto profile = profile_section(scenes)) report.sections.push_back(std::move(*profile));
  for (const SceneAccuracy& scene : scenes) {
    add_findings(report, scene);
    add_asked_findings(report, scene);
    StudySection section{scene.scene, scene.notes, {}, accuracy_charts(scene), {}};
    for (NamedChart& chart : asked_charts(scene)) section.charts.push_back(std::move(chart));
    if (!scene.points.empty()) section.tables.push_back(tolerance_table(scene));
    if (!scene.steps.empty()) section.tables.push_back(step_table(scene));
    section.tables.push_back(cheapest_table(scene));
    for (ResultTable& table : asked_tables(scene)) section.tables.push_back(std::move(table));
    report.sections.push_back(std::move(section));
  }
  report.sections.push_back(
      {"How it was measured",
       {describe_measuring(scenes.front().options.runs) +
            " Times of a step exclude the set-up before the first step; those of a second of motion have their share "
            "of it.",
        fmt::format(
            "Tolerances decide when a step ends; the limit of {} iterations is only a safeguard. The reference of "
            "solves "
            "is Newton's method, iterated until only rounding changes. Quasi-Newton does the same independently, "
            "and the distance between the two is the uncertainty of the reference. That of motions and time steps is "
            "Verlet's in very small steps, or SDIRK2's where something is solved for, extrapolated.",
            most_study_iterations),
        "Solve error: distance of one step's result from the exact result, starting from the same state. Motion error: "
        "what these errors have accumulated to since the start. Time-step error: distance from a motion with steps so "
        "small that their length no longer matters, each solved to 1e-9 m."},
       {},
       {},
       {}});
  return report;
}

}  // namespace drape
