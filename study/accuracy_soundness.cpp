#include "study/accuracy_soundness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drape {
namespace {

bool all_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// Returns true if a case has finite times, or a failure.
bool is_sound(const CaseRuns& runs) {
  const bool timed = !runs.microseconds.empty() || !runs.failure.empty();
  return timed && all_finite(runs.microseconds) && all_finite(runs.setup);
}

/// Returns true if the lists of a motion's steps have matching sizes; they may be empty.
bool is_sound(const MotionPoint& point, std::size_t times) {
  const std::size_t judged = point.local_errors.size();
  return is_sound(point.measured) && point.errors.size() == times && point.local_unknown.size() == judged &&
         point.estimates.size() >= judged && point.converged.size() >= judged;
}

}  // namespace

std::string unsound_in(const SceneAccuracy& scene) {
  const std::size_t times = scene.options.times.size();
  const bool moves = !scene.steps.empty() || !scene.asked.empty() || !scene.fixed.empty();
  if (times == 0) return "there are no times";
  if (!scene.points.empty() && scene.apart.size() != times) return "there are not as many 'apart' as 'times'";
  if (moves && (scene.step_gained.empty() || scene.step_gained.size() > times)) {
    return "there are not as many 'step_gained' as 'times'";
  }
  const auto bad_tolerance = [&](const TolerancePoint& p) { return !is_sound(p.measured) || p.motion.size() != times; };
  const auto bad_step = [](const StepPoint& p) { return !is_sound(p.measured); };
  const auto bad_motion = [&](const MotionPoint& p) { return !is_sound(p, times); };
  if (std::ranges::any_of(scene.points, bad_tolerance)) return "of a tolerance not everything is there";
  if (std::ranges::any_of(scene.steps, bad_step)) return "of a step not everything is there";
  if (std::ranges::any_of(scene.asked, bad_motion)) return "of an accuracy not everything is there";
  if (std::ranges::any_of(scene.fixed, bad_motion)) return "of a fixed step not everything is there";
  return {};
}

}  // namespace drape
