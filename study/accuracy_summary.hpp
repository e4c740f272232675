#pragma once

#include <optional>
#include <vector>

#include "study/accuracy.hpp"
#include "study/report.hpp"

namespace drape {

/// Returns the least cost of a method's fixed steps, with the default tolerance, for this error [m] at the first time
/// [ms per second of motion]. Interpolates linearly between logarithms of two runs. Nothing if no run is so accurate.
std::optional<double> fixed_step_cost(const SceneAccuracy& scene, StepMethod method, double error);

/// Summarises motions with an accuracy over all scenes: recommended settings, cost relative to fixed steps, quality of
/// the estimates. Nothing without such motions.
std::optional<StudySection> asked_summary(const std::vector<SceneAccuracy>& scenes);

/// Summarises the cost of a step by its solve error, scene and method. Nothing without solve errors.
std::optional<StudySection> solve_summary(const std::vector<SceneAccuracy>& scenes);

}  // namespace drape
