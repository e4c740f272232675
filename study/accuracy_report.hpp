#pragma once

#include <optional>
#include <vector>

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

/// Returns the least cost of a method's fixed steps, with the default tolerance, for this error [m] at the first time
/// [ms per second of motion]. Interpolates linearly between logarithms of two runs. Nothing if no run is so accurate.
std::optional<double> fixed_step_cost(const SceneAccuracy& scene, StepMethod method, double error);

/// Summarises motions with an accuracy over all scenes: recommended settings, cost relative to fixed steps, quality of
/// the estimates. Nothing without such motions.
std::optional<StudySection> asked_summary(const std::vector<SceneAccuracy>& scenes);

/// Summarises the cost of a step by its solve error, scene and method. Nothing without solve errors.
std::optional<StudySection> solve_summary(const std::vector<SceneAccuracy>& scenes);

/// An accuracy study of several scenes, complete for its report.
struct AccuracyStudy {
  std::string command;  ///< options that decide its results: a study continues only one with the same
  std::vector<SceneAccuracy> scenes;
  std::vector<std::vector<StudyPicture>> pictures;                   ///< animations of each scene; same size as scenes
  double seconds = 0;                                                ///< duration of the study
  std::vector<std::pair<std::string, std::string>> provenance = {};  ///< program and machine, see study_provenance()
  std::string typed_command = {};                                    ///< command line as typed; empty: `command`
};

/// Returns the report of a study for all output formats.
StudyReport accuracy_report(const AccuracyStudy& study);

}  // namespace drape
