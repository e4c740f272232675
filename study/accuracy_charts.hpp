#pragma once

#include "study/accuracy.hpp"
#include "study/report.hpp"

namespace drape {

/// The work-precision diagrams of a scene: of the solve, of the motion at each time, of the time step, and how the two
/// references part.
std::vector<NamedChart> accuracy_charts(const SceneAccuracy& scene);

/// The command of the study of a scene, with all that was asked.
std::string study_command(const SceneAccuracy& scene);

/// The commands that make a motion's point again.
std::string motion_commands(const SceneAccuracy& scene, const MotionPoint& point);

/// Of the axis of cost().
inline constexpr const char* cost_title = "CPU time per second of motion [ms], median and 95 % interval";

/// What a diagram draws as a bar; nothing where it is not known.
std::optional<std::array<double, 2>> spread_of(const MedianInterval& time);

}  // namespace drape
