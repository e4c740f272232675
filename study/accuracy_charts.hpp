#pragma once

#include "study/accuracy.hpp"
#include "study/report.hpp"

namespace drape {

/// The work-precision diagrams of a scene: of the solve, of the motion at each time, of the time step, and how the two
/// references part.
std::vector<NamedChart> accuracy_charts(const SceneAccuracy& scene);

/// The command of the study of a scene, with all that was asked.
std::string study_command(const SceneAccuracy& scene);

/// The cost of a step's length: computing time for a second of motion [ms].
Quartiles cost_of_motion(const StepPoint& point);

}  // namespace drape
