#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "study/accuracy.hpp"

namespace drape {
namespace {

constexpr double shortest_part = 1e-9;           // rounding tolerance, as a share of a step
constexpr std::int64_t most_small_steps = 2000;  // limit for the smallest default step
constexpr int most_halvings = 6;

std::vector<double> default_steps(double h, double time) {
  std::vector<double> steps;
  for (int i = 0; i <= most_halvings; ++i, h /= 2) {
    if (i > 2 && steps_until(time, h) > most_small_steps) break;
    steps.push_back(h);
  }
  return steps;
}

/// Sorts in descending order and removes duplicates.
void tidy(std::vector<double>& values) {
  std::sort(values.rbegin(), values.rend());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

std::string names_of(const AccuracyParts& parts) {
  std::string names;
  for (const auto& [name, part] : accuracy_parts) {
    if (parts.*part) names.append(names.empty() ? "" : ",").append(name);
  }
  return names;
}

AccuracyOptions complete(AccuracyOptions options, const Scene& scene) {
  const double h = scene.simulation.step, duration = scene.duration;
  if (options.methods.empty()) {
    options.methods = {Method::implicit,
                       Method::liu13,
                       Method::quasi_newton,
                       Method::semi_implicit,
                       Method::verlet,
                       {Method::implicit, TimeScheme::sdirk2},
                       {Method::liu13, TimeScheme::sdirk2},
                       {Method::quasi_newton, TimeScheme::sdirk2}};
  }
  if (options.tolerances.empty()) options.tolerances = {1, 0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
  if (options.accuracies.empty()) options.accuracies = {1e-2, 1e-3, 1e-4};
  if (options.times.empty()) options.times = {duration / 20, duration / 8, duration / 4};
  for (double& time : options.times) {
    const std::int64_t steps = steps_until(time, h);
    if (steps < 1 || steps > scene.step_count()) {
      throw UsageError(fmt::format("--times: {:g} s is beyond the motion of {}, which lasts {:g} s", time,
                                   shown(scene.file), duration));
    }
    time = static_cast<double>(steps) * h;
  }
  std::sort(options.times.begin(), options.times.end());
  options.times.erase(std::unique(options.times.begin(), options.times.end()), options.times.end());
  if (options.steps.empty()) options.steps = default_steps(h, options.times.front());
  tidy(options.steps);
  tidy(options.tolerances);
  tidy(options.accuracies);
  for (const double step : options.steps) {
    const double count = options.times.front() / step;
    if (!(count >= 1 - shortest_part) || std::abs(count - std::round(count)) > shortest_part * count) {
      throw UsageError(fmt::format("--steps: {:g} s does not divide {:g} s, the first of --times, in {}", step,
                                   options.times.front(), shown(scene.file)));
    }
  }
  return options;
}

}  // namespace drape
