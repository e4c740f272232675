#pragma once

#include "study/accuracy.hpp"
#include "study/report.hpp"

namespace drape {

/// Returns the work-precision diagrams of a scene (solve, motion at each time, time step) and the distance of the two
/// references over time.
std::vector<NamedChart> accuracy_charts(const SceneAccuracy& scene);

/// Returns the command of a scene's study with all its options.
std::string study_command(const SceneAccuracy& scene);

/// Returns the commands that reproduce a motion's point.
std::string motion_commands(const SceneAccuracy& scene, const MotionPoint& point);

/// Axis title for cost().
inline constexpr const char* cost_title = "CPU time per second of motion [ms], median and 95 % interval";

/// Returns the ends of a diagram's error bar; nothing if unknown.
std::optional<std::array<double, 2>> spread_of(const MedianInterval& time);

}  // namespace drape
