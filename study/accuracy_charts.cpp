#include "study/accuracy_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/shell.hpp"
#include "scene/method_names.hpp"
#include "study/method_series.hpp"

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
  return text + runs_option(scene.options.runs);
}

std::string film(const SceneAccuracy& scene, StepMethod method, const char* key, double value) {
  return fmt::format("out/{}-{}-{}{}.gif", scene.name, step_method_name(method), key, plain_number(value));
}

std::string commands(const SceneAccuracy& scene, const TolerancePoint& point) {
  return fmt::format("{}\n{}", command_of(scene, {step_method_name(point.method), "solve", {point.tolerance}, {}, {}}),
                     point.measured.what.film_command(film(scene, point.method, "tolerance", point.tolerance)));
}

std::string commands(const SceneAccuracy& scene, const StepPoint& point) {
  return fmt::format("{}\n{}",
                     command_of(scene, {step_method_name(point.method), "order", {}, scene.options.steps, {}}),
                     point.measured.what.film_command(film(scene, point.method, "step", point.step)));
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
      point.measured.what.film_command(film(scene, point.method, asked ? "accuracy" : "h", point.setting)));
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

}  // namespace drape
