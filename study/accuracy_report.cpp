#include "study/accuracy_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "scene/method_names.hpp"
#include "study/accuracy_asked.hpp"
#include "study/accuracy_charts.hpp"
#include "study/profile.hpp"

namespace drape {
namespace {

constexpr std::array<double, 4> limits{1e-3, 1e-4, 1e-5, smallest_error};

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
                   "twice that, which changes it by {:.2g} m; its two solvers differ by {:.2g} m.",
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

/// A kind of error: what every point offers.
struct Kind {
  std::string name, unit;
  std::vector<Offer> offers;
};

std::vector<Kind> kinds_of(const SceneAccuracy& scene) {
  std::vector<Kind> kinds;
  if (!scene.points.empty()) {
    kinds.push_back({"solve", "µs per step", {}});
    for (const double time : scene.options.times) {
      kinds.push_back({fmt::format("motion at {:g} s", time), "µs per step", {}});
    }
  }
  for (const TolerancePoint& p : scene.points) {
    Offer offer{step_method_name(p.method), fmt::format("ε = {:g} {}", p.tolerance, scene.tolerance_unit), p.solve.max,
                p.measured.time()};
    kinds[0].offers.push_back(offer);
    for (std::size_t i = 0; i < p.motion.size(); ++i) {
      offer.error = p.motion[i].max;
      kinds[i + 1].offers.push_back(offer);
    }
  }
  if (scene.steps.empty()) return kinds;
  Kind steps{fmt::format("time step at {:g} s", scene.options.times.front()), "ms per second of motion", {}};
  for (const StepPoint& p : scene.steps) {
    steps.offers.push_back(
        {step_method_name(p.method), fmt::format("h = {:g} s", p.step), p.error.max, p.measured.cost()});
  }
  kinds.push_back(std::move(steps));
  return kinds;
}

/// Why errors below a limit cannot be told, for the kind of a number; empty if they can.
std::string why_unknown(const SceneAccuracy& scene, std::size_t kind, double limit) {
  if (kind == 0 && !scene.points.empty()) return {};
  const std::size_t motions = scene.points.empty() ? 0 : scene.apart.size();
  if (kind <= motions && motions > 0) {
    return scene.apart[kind - 1] < limit ? std::string() : "unknown: the motion is chaotic";
  }
  return scene.step_gained.front() < limit ? std::string() : "unknown: the reference is not accurate enough";
}

ResultTable cheapest_table(const SceneAccuracy& scene) {
  ResultTable table{scene.name + "-cheapest",
                    fmt::format("{}: what accuracy costs", scene.scene),
                    {"error", "below", "cheapest", "at", "cost", "unit", "next best", "next at", "next cost"},
                    {},
                    {}};
  const std::vector<Kind> kinds = kinds_of(scene);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    for (const double limit : limits) {
      const Cheapest c = find_cheapest(kinds[k].offers, limit);
      std::vector<std::string> row{kinds[k].name, readable_length(limit)};
      const std::string unknown = why_unknown(scene, k, limit);
      if (!unknown.empty() || c.first == nullptr) {
        row.emplace_back(unknown.empty() ? "none of those run" : unknown);
        row.resize(table.columns.size(), "–");
      } else {
        row.insert(row.end(), {c.first->method, c.first->at, three_digits(c.first->cost.median), kinds[k].unit});
        if (c.next != nullptr) {
          row.insert(row.end(), {c.next->method, c.next->at, three_digits(c.next->cost.median)});
        }
        row.resize(table.columns.size(), "–");
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

/// "The cheapest below 1 mm is liu13 at ε = 0.001 m with 88.1 µs per step; below 0.1 mm it is …"
std::string describe_cheapest(const SceneAccuracy& scene) {
  const std::vector<Kind> kinds = kinds_of(scene);
  std::string text = "The cheapest";
  for (const double limit : limits) {
    const Cheapest c = find_cheapest(kinds.front().offers, limit);
    text += fmt::format("{} below {} is {}", limit == limits.front() ? "" : "; the cheapest", readable_length(limit),
                        c.first == nullptr ? "none of those run"
                                           : fmt::format("{} at {} with {} µs per step", c.first->method, c.first->at,
                                                         three_digits(c.first->cost.median)));
  }
  return text + ".";
}

/// "semi-implicit 0.99, implicit 0.87 (from h = 0.00125 s to 0.000625 s)"
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
    const Cheapest c = find_cheapest(kinds_of(scene).front().offers, smallest_error);
    if (c.first == nullptr) continue;
    least = std::min(least, c.first->cost.median);
    most = std::max(most, c.first->cost.median);
  }
  if (!(most > 0)) return "What accuracy costs";
  if (least == most) return fmt::format("A step solved to 1 µm costs {} µs", three_digits(most));
  return fmt::format("A step solved to 1 µm costs {} to {} µs", three_digits(least), three_digits(most));
}

}  // namespace

Cheapest find_cheapest(const std::vector<Offer>& offers, double limit) {
  Cheapest found;
  const auto best = [&](const std::string& but) {
    const Offer* least = nullptr;
    for (const Offer& offer : offers) {
      if (!(offer.error < limit) || offer.method == but) continue;
      // The same iterations: what differs is the clock's scatter.
      if (least != nullptr && offer.method == least->method && offer.error == least->error) continue;
      if (least == nullptr || offer.cost.median < least->cost.median) least = &offer;
    }
    return least;
  };
  found.first = best("");
  if (found.first != nullptr) found.next = best(found.first->method);
  return found;
}

StudyReport accuracy_report(const AccuracyStudy& study) {
  const std::vector<SceneAccuracy>& scenes = study.scenes;
  StudyReport report;
  report.kind = "drape study accuracy";
  report.title = "What accuracy costs in time";
  report.headline = headline(scenes);
  report.introduction =
      "Error against computing time: of a step relative to the exact minimiser, and of a motion relative to the "
      "reference motion. Each point is a method with a tolerance, a time step or a requested accuracy. Lower and "
      "further "
      "left is better.";
  report.command = study.command;
  report.seconds = study.seconds;
  report.provenance = study.provenance;
  if (auto profile = profile_section(scenes)) report.sections.push_back(std::move(*profile));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const SceneAccuracy& scene = scenes[i];
    add_findings(report, scene);
    add_asked_findings(report, scene);
    StudySection section{scene.scene, scene.notes, {}, accuracy_charts(scene), study.pictures[i]};
    for (NamedChart& chart : asked_charts(scene)) section.charts.push_back(std::move(chart));
    if (!scene.points.empty()) section.tables.push_back(tolerance_table(scene));
    if (!scene.steps.empty()) section.tables.push_back(step_table(scene));
    if (!scene.points.empty() || !scene.steps.empty()) section.tables.push_back(cheapest_table(scene));
    for (ResultTable& table : asked_tables(scene)) section.tables.push_back(std::move(table));
    report.sections.push_back(std::move(section));
  }
  report.sections.push_back(
      {"How it was measured",
       {describe_measuring(scenes.front().options.runs) + " Step times exclude the set-up before the first step.",
        fmt::format(
            "Tolerances decide when a step ends; the limit of {} iterations is only a safeguard. The reference is "
            "Newton's method, iterated until only rounding changes. Quasi-Newton does the same independently, "
            "and the distance between the two is the uncertainty of the reference.",
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
