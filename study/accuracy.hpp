#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "run/progress.hpp"
#include "study/measure.hpp"
#include "study/reference.hpp"
#include "study/solve_error.hpp"

namespace drape {

/// How many times finer than the smallest step asked for a reference in time is.
inline constexpr std::int64_t reference_refinement = 4;

/// What is asked. What is left empty has the defaults that complete() fills in.
struct AccuracyOptions {
  std::vector<StepMethod>
      methods;  ///< empty: all; those but backward Euler take part in the error of the time step only
  std::vector<double> tolerances;  ///< empty: 1, 0.1, … 1e-7 [m] or [N], as the scene's stopping rule has it
  std::vector<double> steps;       ///< empty: the scene's step and its halves [s]
  std::vector<double> times;       ///< of the motion's error; empty: 1/20, 1/8 and 1/4 of the scene's duration [s]
  std::vector<std::string> overrides;
  int runs = 5;
};

/// A method with a tolerance.
struct TolerancePoint {
  StepMethod method = Method::implicit;
  double tolerance = 0;
  Measured measured;
  SolveError solve;
  std::vector<Distance> motion;  ///< to the reference at every time
};

/// A method with a time step.
struct StepPoint {
  StepMethod method = Method::implicit;
  double step = 0;  ///< h [s]
  Measured measured;
  Distance error;    ///< at the first time
  double order = 0;  ///< measured between this step and the next larger one; not a number for the largest
};

/// What accuracy costs in one scene.
struct SceneAccuracy {
  std::string name;                  ///< of its files
  std::string scene;                 ///< its file, as it was given
  AccuracyOptions options;           ///< complete
  double step = 0;                   ///< of the scene [s]
  const char* tolerance_unit = "m";  ///< or "N"

  std::vector<double> apart;           ///< of the two references at every time [m]
  std::vector<double> apart_by_step;   ///< after every step of the whole motion
  std::optional<double> chaotic_from;  ///< when the two references part by more than smallest_error [s]
  double solve_apart = 0;              ///< of the two exact results of a step, at most [m]
  std::size_t states = 0, left_out = 0;
  double step_reference = 0, step_gained = 0, step_apart = 0;  ///< see StepReference

  std::vector<TolerancePoint> points;  ///< by method, then tolerance as given
  std::vector<StepPoint> steps;        ///< by method, then step as given
  std::vector<std::string> notes;      ///< what was left out, and why
};

/// The smallest error that a study tells apart [m].
inline constexpr double smallest_error = 1e-6;

/// Iterations after which a step is given up, whatever the method: the tolerance is to decide.
inline constexpr int most_study_iterations = 5000;

/// The scene's defaults for what was not asked, and times rounded to whole steps.
/// @throws UsageError if a time is outside of the motion, or a step does not divide the first time
AccuracyOptions complete(AccuracyOptions options, const Scene& scene);

/// Finds out what study_accuracy() would only find out after hours: whether every case of the scene can be run.
/// @throws UsageError
void check_accuracy(const std::string& file, const AccuracyOptions& options);

/// @param name  of the scene's files
/// @param file  as a command names it, relative to the working folder
/// @returns nothing if it was stopped
/// @throws UsageError, DivergedError
std::optional<SceneAccuracy> study_accuracy(const std::string& name, const std::string& file,
                                            const AccuracyOptions& options, const std::stop_token& stop,
                                            Progress& progress);

}  // namespace drape
