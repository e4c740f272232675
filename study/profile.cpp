#include "study/profile.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/text.hpp"
#include "drape/scene/scene.hpp"
#include "reports/chart.hpp"

namespace drape {

double fitted_exponent(const std::vector<std::array<double, 2>>& points) {
  double count = 0, x_sum = 0, y_sum = 0, xx_sum = 0, xy_sum = 0;
  for (const auto& [px, py] : points) {
    if (!(px > 0) || !(py > 0)) continue;
    const double x = std::log(px), y = std::log(py);
    ++count;
    x_sum += x;
    y_sum += y;
    xx_sum += x * x;
    xy_sum += x * y;
  }
  return (count * xy_sum - x_sum * y_sum) / (count * xx_sum - x_sum * x_sum);
}

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

std::string percentage(double share) { return fmt::format("{:.0f} %", 100 * share); }

/// Returns the least cost of a method's runs below a target.
double least_cost(const SceneAccuracy& scene, StepMethod method, double target) {
  double least = never;
  for (const auto* points : {&scene.fixed, &scene.asked}) {
    for (const MotionPoint& p : *points) {
      if (p.method != method || !p.measured.failure.empty() || !(p.errors.front().max < target)) continue;
      least = std::min(least, p.measured.cost().median);
    }
  }
  return least;
}

/// Returns the reason of a method's last failed run; empty if none failed.
std::string failure_of(const SceneAccuracy& scene, StepMethod method) {
  std::string why;
  for (const auto* points : {&scene.fixed, &scene.asked}) {
    for (const MotionPoint& p : *points) {
      if (p.method == method && !p.measured.failure.empty()) why = p.measured.failure;
    }
  }
  return why;
}

NamedChart profile_chart(const std::vector<ProfileCurve>& curves) {
  html::Chart chart{
      "Performance profiles: the share of the problems (a scene with an error of 1 mm or 0.1 mm) that a method solves "
      "within so many times the time of the fastest.",
      "τ: times the time of the fastest",
      "share of the problems",
      html::Scale::logarithmic,
      html::Scale::linear,
      {},
      {}};
  constexpr double least_last = 2;  // also if all solvers are equally fast
  double last = least_last;
  chart.x_holds = {1, least_last};
  chart.y_holds = {0, 1};
  for (const ProfileCurve& curve : curves) {
    if (!curve.ratios.empty()) last = std::max(last, curve.ratios.back());
  }
  for (const ProfileCurve& curve : curves) {
    html::ChartSeries series = method_series(curve.solver);
    series.markers = false;
    const auto add = [&](double tau, double share) {
      series.points.push_back(
          {tau, share, fmt::format("{} within {:.3g} times the best", percentage(share), tau), {}, {}});
    };
    double share = curve.share(1);
    add(1, share);
    for (const double ratio : curve.ratios) {
      const double next = curve.share(ratio);
      if (next == share) continue;
      add(ratio, share);
      add(ratio, share = next);
    }
    add(last, share);
    chart.series.push_back(std::move(series));
  }
  return {"profile", std::move(chart)};
}

ResultTable profile_table(const std::vector<ProfileCurve>& curves) {
  ResultTable table{"profiles",
                    "Performance profiles: the share of the problems that a method solves",
                    {"method", "as the fastest", "within 1.5 times", "2 times", "4 times", "10 times", "at all"},
                    {},
                    {}};
  for (const ProfileCurve& curve : curves) {
    table.rows.push_back({curve.solver});
    for (const double tau : {1.0, 1.5, 2.0, 4.0, 10.0, never})
      table.rows.back().push_back(percentage(curve.share(tau)));
  }
  return table;
}

ResultTable times_table(const ProfileTimes& times) {
  ResultTable table{"profile-times", "What the problems cost [ms per second of motion]", {"problem"}, {}, {}};
  table.columns.insert(table.columns.end(), times.solvers.begin(), times.solvers.end());
  table.notes.emplace_back(
      "The least median among a method's runs, with fixed steps (default tolerance) or with an accuracy, that end "
      "nearer to the reference than the problem asks. –: none does.");
  table.notes.insert(table.notes.end(), times.misses.begin(), times.misses.end());
  for (std::size_t p = 0; p < times.problems.size(); ++p) {
    table.rows.push_back({times.problems[p]});
    for (const std::vector<double>& of_solver : times.times) table.rows.back().push_back(three_digits(of_solver[p]));
  }
  return table;
}

}  // namespace

double ProfileCurve::share(double tau) const {
  const auto within = std::ranges::upper_bound(ratios, tau) - ratios.begin();
  return problems == 0 ? 0 : static_cast<double>(within) / static_cast<double>(problems);
}

std::vector<ProfileCurve> performance_profile(const ProfileTimes& times) {
  std::vector<ProfileCurve> curves;
  for (const std::string& solver : times.solvers) curves.push_back({solver, {}, times.problems.size()});
  for (std::size_t p = 0; p < times.problems.size(); ++p) {
    double best = never;
    for (const std::vector<double>& of_solver : times.times) best = std::min(best, of_solver[p]);
    for (std::size_t s = 0; s < curves.size(); ++s) {
      if (std::isfinite(times.times[s][p])) curves[s].ratios.push_back(times.times[s][p] / best);
    }
  }
  for (ProfileCurve& curve : curves) std::ranges::sort(curve.ratios);
  return curves;
}

ProfileTimes profile_times(const std::vector<SceneAccuracy>& scenes, std::vector<std::string>& notes) {
  ProfileTimes times;
  std::vector<StepMethod> methods;
  for (const StepMethod method : step_methods) {
    if (std::ranges::any_of(scenes, [method](const SceneAccuracy& s) {
          return std::ranges::find(s.options.methods, method) != s.options.methods.end();
        })) {
      methods.push_back(method);
      times.solvers.push_back(step_method_name(method));
    }
  }
  times.times.resize(methods.size());
  for (const SceneAccuracy& scene : scenes) {
    if (scene.asked.empty() && scene.fixed.empty()) continue;
    for (const double target : profile_targets) {
      const std::string problem = fmt::format("{}, {}", scene.scene, readable_length(target));
      if (!(scene.step_gained.front() < target)) {
        notes.push_back(
            fmt::format("{} is no problem here: its reference gains {} by extrapolation, so it is not known "
                        "well enough.",
                        problem, readable_length(scene.step_gained.front())));
        continue;
      }
      times.problems.push_back(problem);
      for (std::size_t s = 0; s < methods.size(); ++s) {
        times.times[s].push_back(least_cost(scene, methods[s], target));
        const std::string why = failure_of(scene, methods[s]);
        if (std::isfinite(times.times[s].back()) || why.empty()) continue;
        times.misses.push_back(fmt::format("{} misses {}: {}", times.solvers[s], problem, why));
      }
    }
  }
  return times;
}

std::optional<StudySection> profile_section(const std::vector<SceneAccuracy>& scenes) {
  StudySection section{"Which method is the fastest", {}, {}, {}, {}};
  const ProfileTimes times = profile_times(scenes, section.text);
  if (times.problems.empty()) return std::nullopt;
  const std::vector<ProfileCurve> curves = performance_profile(times);
  std::size_t unsolved = 0;
  for (std::size_t p = 0; p < times.problems.size(); ++p) {
    unsolved += std::ranges::none_of(times.times, [p](const auto& of) { return std::isfinite(of[p]); }) ? 1 : 0;
  }
  section.text.insert(
      section.text.begin(),
      fmt::format("{} problems, each a scene and how far the cloth may be from the reference at the first "
                  "of the times compared{}. (Dolan and Moré 2002.)",
                  times.problems.size(), unsolved > 0 ? fmt::format("; no method solved {}", unsolved) : ""));
  section.charts.push_back(profile_chart(curves));
  section.tables = {profile_table(curves), times_table(times)};
  return section;
}

}  // namespace drape
