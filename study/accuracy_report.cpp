#include "study/accuracy_report.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/console.hpp"
#include "core/text.hpp"
#include "drape/scene/scene.hpp"
#include "reports/chart.hpp"
#include "reports/listing.hpp"
#include "study/profile.hpp"

namespace drape {
namespace {

std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text.append(text.empty() ? "" : ",").append(plain_number(value));
  return text;
}

/// The part of a scene's study that a command repeats.
struct Again {
  std::string methods, parts;
  std::vector<double> tolerances, steps, accuracies;
};

std::string command_of(const SceneAccuracy& scene, const Again& again) {
  std::string text = "drape study accuracy " + shell_file(scene.scene);
  for (const std::string& value : scene.options.overrides) text += " --set " + shell_word(value);
  text += fmt::format(" --parts {} --methods {} --times {}", again.parts, again.methods, list(scene.options.times));
  const auto add = [&text](const char* option, const std::vector<double>& values) {
    if (!values.empty()) text += fmt::format(" {} {}", option, list(values));
  };
  add("--tolerances", again.tolerances);
  add("--steps", again.steps);
  add("--accuracies", again.accuracies);
  if (scene.options.patience != AccuracyOptions().patience)
    text += " --patience " + plain_number(scene.options.patience);
  return text + runs_option(scene.options.runs);
}

std::string film(const SceneAccuracy& scene, StepMethod method, const char* key, double value) {
  return fmt::format("out/{}-{}-{}{}.gif", scene.name, step_method_name(method), key, plain_number(value));
}

std::string commands(const SceneAccuracy& scene, const TolerancePoint& point) {
  return fmt::format("{}\n{}", command_of(scene, {step_method_name(point.method), "solve", {point.tolerance}, {}, {}}),
                     point.measured.study_case.film_command(film(scene, point.method, "tolerance", point.tolerance)));
}

std::string commands(const SceneAccuracy& scene, const StepPoint& point) {
  return fmt::format("{}\n{}",
                     command_of(scene, {step_method_name(point.method), "order", {}, scene.options.steps, {}}),
                     point.measured.study_case.film_command(film(scene, point.method, "step", point.step)));
}

/// Plots error(point) against time per step, one series per method.
template <class Error>
html::Chart by_time(const SceneAccuracy& scene, const std::string& title, const std::string& y_title, Error error) {
  html::Chart chart{title,
                    "time per step [µs], median and its 95 % interval",
                    y_title,
                    html::Scale::logarithmic,
                    html::Scale::logarithmic,
                    {},
                    {}};
  for (const StepMethod method : scene.options.methods) {
    html::ChartSeries series = method_series(step_method_name(method));
    for (const TolerancePoint& p : scene.points) {
      if (p.method != method) continue;
      const MedianInterval time = p.measured.time();
      series.points.push_back(
          {time.median, error(p),
           fmt::format("ε = {:g} {}: {:.1f} µs per step ({} to {}), {:.3g} m", p.tolerance, scene.tolerance_unit,
                       time.median, three_digits(time.lower), three_digits(time.upper), error(p)),
           commands(scene, p), spread_of(time)});
    }
    if (!series.points.empty()) chart.series.push_back(std::move(series));
  }
  return chart;
}

NamedChart motion_chart(const SceneAccuracy& scene, std::size_t i) {
  const double time = scene.options.times[i];
  std::string title = fmt::format("Motion error at {:g} s: the largest distance of a vertex from the reference.", time);
  const bool chaotic = scene.chaotic_from && time >= *scene.chaotic_from;
  if (chaotic) {
    title += fmt::format(
        " The motion is chaotic from {:g} s: nearby motions diverge, and errors near or below the dashed line are "
        "those of the reference.",
        *scene.chaotic_from);
  }
  html::Chart chart = by_time(scene, title, "error [m]", [i](const TolerancePoint& p) { return p.motion.at(i).max; });
  if (scene.apart[i] > 0) chart.levels.push_back({scene.apart[i], "distance between the two references"});
  return {fmt::format("{}-motion-{}", scene.name, i + 1), std::move(chart)};
}

template <class Across>
html::Chart by_step(const SceneAccuracy& scene, const std::string& title, const std::string& x_title, Across across,
                    bool with_spread) {
  html::Chart chart{title, x_title, "error [m]", html::Scale::logarithmic, html::Scale::logarithmic, {}, {}};
  for (const StepMethod method : scene.options.methods) {
    html::ChartSeries series = method_series(step_method_name(method));
    for (const StepPoint& p : scene.steps) {
      if (p.method != method) continue;
      const MedianInterval cost = p.measured.cost();
      std::string label =
          fmt::format("h = {:g} s: {:.3g} m, {:.3g} ms per second of motion", p.step, p.error.max, cost.median);
      if (std::isfinite(p.order)) label += fmt::format(", order {:.2f} from the step before", p.order);
      html::ChartPoint point{across(p), p.error.max, std::move(label), commands(scene, p), {}};
      if (with_spread) point.spread = spread_of(cost);
      series.points.push_back(std::move(point));
    }
    if (!series.points.empty()) chart.series.push_back(std::move(series));
  }
  if (scene.step_gained.front() > 0)
    chart.levels.push_back({scene.step_gained.front(), "uncertainty of the reference"});
  return chart;
}

NamedChart apart_chart(const SceneAccuracy& scene) {
  html::ChartSeries series{"Newton and quasi-Newton", {}, false};
  series.style = 5;  // used by no method
  for (std::size_t i = 0; i < scene.apart_by_step.size(); ++i) {
    const double time = static_cast<double>(i + 1) * scene.step;
    series.points.push_back(
        {time, scene.apart_by_step[i], fmt::format("{:g} s: {:.2g} m apart", time, scene.apart_by_step[i]), {}, {}});
  }
  return {scene.name + "-apart",
          {"Distance between the two references: the effect of rounding alone.",
           "time [s]",
           "largest vertex distance [m]",
           html::Scale::linear,
           html::Scale::logarithmic,
           {std::move(series)},
           {{smallest_error, "1 µm"}}}};
}

}  // namespace

std::string study_command(const SceneAccuracy& scene) {
  const AccuracyOptions& options = scene.options;
  std::string methods;
  for (const StepMethod method : options.methods)
    methods.append(methods.empty() ? "" : ",").append(step_method_name(method));
  return command_of(scene, {methods, names_of(options.parts), options.tolerances, options.steps, options.accuracies});
}

std::string motion_commands(const SceneAccuracy& scene, const MotionPoint& point) {
  const bool asked = std::ranges::any_of(scene.asked, [&](const MotionPoint& p) { return &p == &point; });
  const std::vector<double> steps = asked ? scene.options.steps : std::vector{point.setting};
  const std::vector<double> accuracies = asked ? std::vector{point.setting} : scene.options.accuracies;
  const AccuracyParts& all = scene.options.parts;
  const std::string parts =
      names_of({.solve = false, .order = false, .asked = true, .estimates = all.estimates, .films = all.films});
  return fmt::format(
      "{}\n{}", command_of(scene, {step_method_name(point.method), parts, {}, steps, accuracies}),
      point.measured.study_case.film_command(film(scene, point.method, asked ? "accuracy" : "h", point.setting)));
}

std::optional<std::array<double, 2>> spread_of(const MedianInterval& time) {
  return time.known() ? std::optional(std::array{time.lower, time.upper}) : std::nullopt;
}

std::vector<NamedChart> accuracy_charts(const SceneAccuracy& scene) {
  std::vector<NamedChart> charts;
  if (!scene.points.empty()) {
    charts.push_back(
        {scene.name + "-solve", by_time(scene,
                                        fmt::format("Solve error: the largest distance of a vertex from the exact "
                                                    "minimiser, mean over {} states along the motion.",
                                                    scene.states),
                                        "error [m]", [](const TolerancePoint& p) { return p.solve.max; })});
    for (std::size_t i = 0; i < scene.options.times.size(); ++i) charts.push_back(motion_chart(scene, i));
  }
  if (!scene.steps.empty()) {
    const double time = scene.options.times.front();
    charts.push_back({scene.name + "-step", by_step(
                                                scene, fmt::format("Time-step error at {:g} s, by step length.", time),
                                                "h [s]", [](const StepPoint& p) { return p.step; }, false)});
    charts.push_back(
        {scene.name + "-step-cost", by_step(
                                        scene, fmt::format("Time-step error at {:g} s, by cost.", time), cost_title,
                                        [](const StepPoint& p) { return p.measured.cost().median; }, true)});
  }
  if (!scene.points.empty()) charts.push_back(apart_chart(scene));
  return charts;
}

namespace {

constexpr std::array<double, 3> wanted{1e-2, 1e-3, 1e-4};  // errors of a motion [m]
constexpr std::array<double, 4> solve_limits{1e-3, 1e-4, 1e-5, smallest_error};

/// Returns the offers of motions with an accuracy.
std::vector<Offer> asked_offers(const SceneAccuracy& scene, bool with_explicit) {
  std::vector<Offer> offers;
  for (const MotionPoint& p : scene.asked) {
    if (!p.measured.failure.empty() || (is_explicit(p.method.method) && !with_explicit)) continue;
    offers.push_back({step_method_name(p.method), fmt::format("accuracy = {}", plain_number(p.setting)),
                      p.errors.front().max, p.measured.cost()});
  }
  return offers;
}

ResultTable take_table(const std::vector<SceneAccuracy>& scenes) {
  ResultTable table{"asked-take", "What to take for an error of the motion", {"scene", "methods"}, {}, {}};
  for (const double limit : wanted) table.columns.push_back("below " + readable_length(limit));
  for (const SceneAccuracy& scene : scenes) {
    for (const bool with_explicit : {true, false}) {
      const std::vector<Offer> offers = asked_offers(scene, with_explicit);
      table.rows.push_back({scene.name, with_explicit ? "all" : "implicit"});
      for (const double limit : wanted) {
        const Offer* const first = find_cheapest(offers, limit).first;
        const bool known = scene.step_gained.front() < limit;
        table.rows.back().push_back(first != nullptr && known ? fmt::format("{}, {}: {}", first->method, first->at,
                                                                            three_digits(first->cost.median))
                                                              : "–");
      }
    }
  }
  table.notes.emplace_back(
      "The cheapest method and accuracy [m] that end so near to the reference at the first time, and ms of computing "
      "time for a second of motion. Implicit methods also take what springs are too stiff, or meshes too fine, for the "
      "explicit ones.");
  return table;
}

/// Returns "13 mm, 30.9 ms, 1.22": final error, cost, and cost relative to the best fixed step.
std::string describe_cost(const SceneAccuracy& scene, const MotionPoint& p) {
  if (!p.measured.failure.empty()) return "–";
  const double error = p.errors.front().max, cost = p.measured.cost().median;
  const std::optional<double> fixed = fixed_step_cost(scene, p.method, error);
  return fmt::format("{:.2g} mm, {} ms, {}", 1e3 * error, three_digits(cost),
                     fixed ? fmt::format("{:.2f}", cost / *fixed) : "–");
}

ResultTable cost_table(const std::vector<SceneAccuracy>& scenes) {
  ResultTable table{"asked-cost", "Cost of requested accuracies", {"scene", "method"}, {}, {}};
  const std::vector<double>& accuracies = scenes.front().options.accuracies;
  for (const double accuracy : accuracies) table.columns.push_back("accuracy = " + plain_number(accuracy));
  for (const SceneAccuracy& scene : scenes) {
    for (const StepMethod method : scene.options.methods) {
      std::vector<std::string> row{scene.name, step_method_name(method)};
      for (const double accuracy : accuracies) {
        const auto found = std::ranges::find_if(scene.asked, [method, accuracy](const MotionPoint& p) {
          return p.method == method && p.setting == accuracy;
        });
        row.push_back(found != scene.asked.end() ? describe_cost(scene, *found) : "–");
      }
      if (std::ranges::any_of(row.begin() + 2, row.end(), [](const std::string& cell) { return cell != "–"; })) {
        table.rows.push_back(std::move(row));
      }
    }
  }
  table.notes.emplace_back(
      "The error of the motion at the first time, ms of computing time for a second of motion, and that by what the "
      "best "
      "fixed step of the same method takes which ends with the same error, with the default tolerance, interpolated "
      "between those that were run (–: none of them gets there).");
  return table;
}

ResultTable checks_table(const std::vector<SceneAccuracy>& scenes) {
  ResultTable table{"asked-checks",
                    "What steps say of their errors, and what these are",
                    {"scene", "steps before", "within a factor of 3", "largest error by estimate", "steps after",
                     "largest", "missed tenfold", "missed, not reported"},
                    {},
                    {}};
  const auto ratio = [](double value) { return value > 0 ? fmt::format("{:.2f}", value) : "–"; };
  for (const SceneAccuracy& scene : scenes) {
    if (!scene.options.parts.estimates) continue;
    EstimateCheck all;
    for (const MotionPoint& p : scene.asked) all += check_estimates(scene, p);
    table.rows.push_back({scene.name, fmt::format("{}", all.judged), fmt::format("{}", all.close),
                          ratio(all.worst_before), fmt::format("{}", all.after), ratio(all.worst_after),
                          fmt::format("{}", all.missed), fmt::format("{}", all.unreported)});
  }
  table.notes.emplace_back(
      "All methods and accuracies together. Before and after the cloth first touches something or buckles. Steps whose "
      "error and estimate are both below a tenth of the accuracy are not judged.");
  return table;
}

ResultTable solve_table(const std::vector<SceneAccuracy>& scenes) {
  ResultTable table{"solve-costs", "What a step costs whose solve ends so near to the minimiser", {}, {}, {}};
  table.columns = {"scene", "method"};
  for (const double limit : solve_limits) table.columns.push_back("below " + readable_length(limit));
  for (const SceneAccuracy& scene : scenes) {
    const std::vector<Offer> offers = solve_offers(scene);
    for (const StepMethod method : scene.options.methods) {
      std::vector<Offer> own;
      std::ranges::copy_if(offers, std::back_inserter(own),
                           [name = step_method_name(method)](const Offer& o) { return o.method == name; });
      if (own.empty()) continue;
      table.rows.push_back({scene.name, step_method_name(method)});
      for (const double limit : solve_limits) {
        const Offer* const least = find_cheapest(own, limit).first;
        table.rows.back().push_back(least != nullptr ? three_digits(least->cost.median) : "–");
      }
    }
  }
  table.notes.emplace_back("µs per step, by the loosest tolerance that gets there.");
  return table;
}

}  // namespace

std::optional<StudySection> solve_summary(const std::vector<SceneAccuracy>& scenes) {
  std::vector<SceneAccuracy> solved;
  std::ranges::copy_if(scenes, std::back_inserter(solved), [](const SceneAccuracy& s) { return !s.points.empty(); });
  if (solved.empty()) return std::nullopt;
  return StudySection{"Solve cost by error", {}, {solve_table(solved)}, {}, {}};
}

std::optional<double> fixed_step_cost(const SceneAccuracy& scene, StepMethod method, double error) {
  std::vector<std::pair<double, double>> runs;  // errors and costs
  for (const MotionPoint& p : scene.fixed) {
    if (p.method == method && p.measured.failure.empty()) {
      runs.emplace_back(p.errors.front().max, p.measured.cost().median);
    }
  }
  std::optional<double> least;
  const auto offer = [&least](double cost) { least = std::min(cost, least.value_or(cost)); };
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto [larger, cost] = runs[i];
    if (larger <= error) offer(cost);
    if (i + 1 == runs.size()) continue;
    const auto [smaller, next_cost] = runs[i + 1];
    if (!(smaller < error && error < larger)) continue;
    const double part = std::log(larger / error) / std::log(larger / smaller);
    offer(cost * std::pow(next_cost / cost, part));
  }
  return least;
}

std::optional<StudySection> asked_summary(const std::vector<SceneAccuracy>& scenes) {
  std::vector<SceneAccuracy> asked;
  std::ranges::copy_if(scenes, std::back_inserter(asked), [](const SceneAccuracy& s) { return !s.asked.empty(); });
  if (asked.empty()) return std::nullopt;
  std::vector<ResultTable> tables{take_table(asked), cost_table(asked)};
  if (ResultTable checks = checks_table(asked); !checks.rows.empty()) tables.push_back(std::move(checks));
  return StudySection{"Requested accuracies",
                      {fmt::format("Errors of motions are at {:g} s.", asked.front().options.times.front())},
                      std::move(tables),
                      {},
                      {}};
}

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

/// Returns the answer in one sentence: of one scene the method to take, of several the range of costs.
std::string headline(const std::vector<SceneAccuracy>& scenes) {
  if (scenes.size() == 1) {
    const std::string answer = first_answer(scenes.front());
    return answer.empty() ? "What accuracy costs" : answer;
  }
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

/// Returns true if a page opens the scenes one at a time.
bool has_list(const AccuracyStudy& study) { return study.scenes.size() >= html::many_entries; }

/// Returns the first answer of cheapest_table(), with the names of its first columns.
std::vector<std::string> first_cheapest(const ResultTable& cheapest) {
  for (const std::vector<std::string>& row : cheapest.rows) {
    if (row.at(3) != "–") return {row.begin(), row.begin() + 6};
  }
  return {"–", "–", "none", "–", "–", "–"};
}

/// Returns the scenes with the cheapest method for the first kind of error that each knows.
StudyList scene_list(const std::vector<SceneAccuracy>& scenes) {
  StudyList list{"scenes", {"answers", "The cheapest method for the first kind of error that is known", {}, {}, {}}};
  list.table.columns = {"scene", "error", "below", "cheapest", "at", "cost", "unit"};
  for (const SceneAccuracy& scene : scenes) {
    std::vector<std::string>& row = list.table.rows.emplace_back(first_cheapest(cheapest_table(scene)));
    row.insert(row.begin(), scene.scene);
  }
  return list;
}

/// Returns the section for a reader with a scene to compute: the pictures, and a method for each error.
StudySection answer_section(const AccuracyStudy& study) {
  StudySection answer{
      "What to take",
      {"Choose the kind of error that matters to you, and how large it may be: the table shows the cheapest "
       "method, its setting and its cost. The evidence follows.",
       "Whole: the distance from the true motion. Its three parts are told apart below. Solve: how far "
       "one step is from its exact result. Motion: what these errors have accumulated to. Time step: "
       "what even exact steps leave, because they are not small."},
      {},
      {},
      {}};
  if (has_list(study)) return answer;  // each scene's section has its own
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
  report.command = study.typed_command.empty() ? study.command : study.typed_command;
  report.seconds = study.seconds;
  report.provenance = study.provenance;
  report.answer = answer_section(study);
  if (has_list(study)) report.list = scene_list(scenes);
  if (auto summary = asked_summary(scenes)) report.sections.push_back(std::move(*summary));
  if (auto summary = solve_summary(scenes)) report.sections.push_back(std::move(*summary));
  if (auto profile = profile_section(scenes)) report.sections.push_back(std::move(*profile));
  for (const SceneAccuracy& scene : scenes) {
    const std::size_t before = report.findings.size();
    add_findings(report, scene);
    add_asked_findings(report, scene);
    for (std::size_t f = before; f < report.findings.size(); ++f) report.findings[f].of = scene.scene;
    StudySection section{scene.scene, scene.notes, {}, accuracy_charts(scene), {}};
    if (has_list(study)) {
      section.group = first_cheapest(cheapest_table(scene)).at(2);
      section.pictures = study.pictures[static_cast<std::size_t>(&scene - scenes.data())];
      section.tables.push_back(answer_table(scene));
    }
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
