#include "study/accuracy_animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/method_names.hpp"
#include "study/accuracy_charts.hpp"
#include "study/animation.hpp"

namespace drape {
namespace {

constexpr std::size_t most_panels = 4;
constexpr double usual_tolerance = 1e-3;

/// Returns up to most_panels elements, evenly spread over a list and including its ends.
template <class T>
std::vector<T> spread(const std::vector<T>& all) {
  if (all.size() <= most_panels) return all;
  std::vector<T> some;
  for (std::size_t i = 0; i < most_panels; ++i) some.push_back(all[i * (all.size() - 1) / (most_panels - 1)]);
  return some;
}

std::string cost_label(double microseconds) {
  return fmt::format("{:.{}f} µs per step", microseconds, microseconds < 100 ? 1 : 0);
}

AnimationPanel panel(const TolerancePoint& p) {
  return {p.measured.what, fmt::format("{}, tolerance {:g}: {}", step_method_name(p.method), p.tolerance,
                                       cost_label(p.measured.time().median))};
}

AnimationPanel panel(const StepPoint& p) {
  return {p.measured.what,
          fmt::format("{}, h = {:g} s: {}", step_method_name(p.method), p.step, cost_label(p.measured.time().median))};
}

/// Returns the method whose tolerance or step varies: Liu13 if present, since its errors are the most visible.
StepMethod shown_method(const SceneAccuracy& accuracy) {
  const std::vector<StepMethod>& methods = accuracy.options.methods;
  const bool has_liu13 = std::find(methods.begin(), methods.end(), StepMethod(Method::liu13)) != methods.end();
  return has_liu13 ? StepMethod(Method::liu13) : methods.front();
}

double nearest_tolerance(const SceneAccuracy& accuracy) {
  const auto off = [](double tolerance) { return std::abs(std::log(tolerance / usual_tolerance)); };
  const std::vector<double>& all = accuracy.options.tolerances;
  return *std::min_element(all.begin(), all.end(), [&](double a, double b) { return off(a) < off(b); });
}

std::vector<AnimationPanel> panels_of(const SceneAccuracy& accuracy, AnimatedBy by) {
  std::vector<AnimationPanel> panels;
  if (by == AnimatedBy::steps) {
    for (const double step : spread(accuracy.options.steps)) {
      for (const StepPoint& p : accuracy.steps) {
        if (p.method == shown_method(accuracy) && p.step == step) panels.push_back(panel(p));
      }
    }
    return panels;
  }
  const std::vector<double> tolerances = by == AnimatedBy::tolerances
                                             ? spread(accuracy.options.tolerances)
                                             : std::vector<double>{nearest_tolerance(accuracy)};
  for (const double tolerance : tolerances) {
    for (const TolerancePoint& p : accuracy.points) {
      const bool shown = by == AnimatedBy::methods || p.method == shown_method(accuracy);
      if (shown && p.tolerance == tolerance) panels.push_back(panel(p));
    }
  }
  return panels;
}

}  // namespace

std::optional<StudyPicture> animate_accuracy(const SceneAccuracy& accuracy, AnimatedBy by,
                                             const std::filesystem::path& folder, GlBackend backend,
                                             const std::stop_token& stop, Progress& progress) {
  const std::vector<AnimationPanel> panels = panels_of(accuracy, by);
  if (panels.size() < 2) return std::nullopt;
  const Scene scene = load_scene(accuracy.scene, accuracy.options.overrides);
  SimulationSettings reference = scene.simulation;
  if (by == AnimatedBy::steps)
    reference.step = accuracy.options.steps.back() / static_cast<double>(reference_refinement);
  const std::string name = animated_by_names[static_cast<std::size_t>(by)];
  StudyPicture picture;
  picture.file = fmt::format("{}-by-{}.gif", accuracy.name, name);
  picture.caption = fmt::format(
      "{} with different {}. Vertices are coloured by their distance from the reference, computed {}. Above each "
      "panel: time per step, current error and flipped pairs of triangles.",
      accuracy.scene, name,
      by == AnimatedBy::steps ? fmt::format("with h = {:g} s", reference.step) : "by Newton's method down to rounding");
  picture.command = fmt::format("{} --animate {}", study_command(accuracy), name);
  auto animation = animate_errors(scene, to_rounding(reference, Method::implicit), panels, folder / picture.file,
                                  backend, stop, progress);
  if (!animation) return std::nullopt;
  picture.bytes = std::move(animation->gif);
  picture.stills = std::move(animation->stills);
  const AnimationPanel& worst = panels[animation->worst_panel];
  picture.motions = {{"the reference", {}, std::move(animation->reference)},
                     {worst.label + ", which ends furthest from the reference", worst.what.film_command("motion.html"),
                      std::move(animation->worst)}};
  return picture;
}

}  // namespace drape
