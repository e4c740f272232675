#pragma once

#include <optional>
#include <vector>

#include "study/accuracy.hpp"
#include "study/report.hpp"

namespace drape {

/// What the cheapest fixed step of a method costs that ends with this error [m] at the first time, the default
/// tolerance given: between two steps that were run, on the straight line of the logarithms [ms per second of motion].
/// Nothing where none of them gets there.
std::optional<double> fixed_step_cost(const SceneAccuracy& scene, StepMethod method, double error);

/// What all scenes together say about accuracies that are asked for: what to take, what it costs beside fixed steps,
/// and whether the estimates hold. Nothing where none was asked for.
std::optional<StudySection> asked_summary(const std::vector<SceneAccuracy>& scenes);

/// What a step costs whose solve is so exact, by scene and method. Nothing where no solve was measured.
std::optional<StudySection> solve_summary(const std::vector<SceneAccuracy>& scenes);

}  // namespace drape
