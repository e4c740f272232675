#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "drape/render/settings.hpp"
#include "run/progress.hpp"
#include "study/measure.hpp"
#include "study/reference.hpp"

namespace drape {

/// Ratio of the smallest requested step to the reference's step, at least.
inline constexpr std::int64_t reference_refinement = 4;

/// The parts of a scene's accuracy study.
struct AccuracyParts {
  bool solve = true;      ///< errors of the solve and of the motion, by method and tolerance
  bool order = true;      ///< convergence order of the methods in the time step, each step solved to the end
  bool asked = true;      ///< motions with [time] accuracy, beside fixed steps with the default tolerance
  bool estimates = true;  ///< true errors of the steps of `asked`, beside their estimates; needs `asked`
  bool films = false;     ///< visual difference of the films of these motions; needs `asked`

  bool operator==(const AccuracyParts&) const = default;
};
inline constexpr std::array<std::pair<const char*, bool AccuracyParts::*>, 5> accuracy_parts{
    {{"solve", &AccuracyParts::solve},
     {"order", &AccuracyParts::order},
     {"asked", &AccuracyParts::asked},
     {"estimates", &AccuracyParts::estimates},
     {"films", &AccuracyParts::films}}};

/// Returns the names of the selected parts: "solve,order,asked,estimates".
std::string names_of(const AccuracyParts& parts);

/// Options of an accuracy study. complete() replaces empty ones by defaults.
struct AccuracyOptions {
  std::vector<StepMethod>
      methods;  ///< empty: all; other schemes than backward Euler are measured for the error of the time step only
  std::vector<double> tolerances;  ///< [m] or [N] by the scene's stopping criterion; empty: 1, 0.1, … 1e-7
  std::vector<double> steps;       ///< [s]; empty: the scene's step and its halves
  std::vector<double> times;       ///< times of the motion errors [s]; empty: 1/20, 1/8 and 1/4 of the scene's duration
  std::vector<double> accuracies;  ///< [m]; empty: 1e-2, 1e-3, 1e-4
  std::vector<std::string> overrides;
  RunCount runs = {};
  double patience = 20;  ///< computing time limit of a motion of `asked` [s]
  AccuracyParts parts = {};
  GlBackend backend = GlBackend::automatic;  ///< backend for the films
  bool of_several_scenes = false;            ///< in each scene, skip the methods that cannot compute it
};

/// The measurements of one case.
struct CaseRuns {
  StudyCase study_case;
  double step = 0;                   ///< step length h [s]
  double iterations = 0;             ///< mean per step
  std::int64_t capped = 0;           ///< number of steps that reached the iteration limit
  double flipped_pairs = 0;          ///< mean over the watched steps, see FlippedPairs
  std::vector<double> microseconds;  ///< mean CPU time per step, for every timed run
  std::vector<double> setup;         ///< CPU time before the first step, for every timed run [µs]
  std::string failure;               ///< reason why the run ended early; empty: complete

  CaseRuns() = default;
  explicit CaseRuns(const Measured& measured);
  [[nodiscard]] MedianInterval time() const { return median_interval(microseconds); }
  /// Returns the CPU time for a second of motion, with its share of the setup time [ms]. Setup counts because runs with
  /// an accuracy do the same work within several steps, not before the first.
  [[nodiscard]] MedianInterval cost() const;
};

/// The measurements of a method with a tolerance.
struct TolerancePoint {
  StepMethod method = Method::implicit;
  double tolerance = 0;
  CaseRuns measured;
  SolveError solve;
  std::vector<Distance> motion;  ///< distance to the reference at each time
};

/// The measurements of a method with a time step.
struct StepPoint {
  StepMethod method = Method::implicit;
  double step = 0;  ///< step length h [s]
  CaseRuns measured;
  Distance error;    ///< error at the first time
  double order = 0;  ///< measured between this step and the next larger one; NaN for the largest
};

/// The measurements of a method with an accuracy, or with a time step and the default tolerance.
struct MotionPoint {
  StepMethod method = Method::implicit;
  double setting = 0;  ///< accuracy [m], or step length h [s]
  CaseRuns measured;
  std::vector<Distance> errors;   ///< distance to the small-step reference at each time; NaN after a failure
  std::optional<double> flip;     ///< FLIP error of the film, see FilmJudge; absent without films
  std::vector<double> film_flip;  ///< FLIP error of each frame
  // For each step up to the first time, if an accuracy was given:
  std::vector<double> substeps;       ///< number of substeps
  std::vector<double> converged;      ///< 1 if converged, else 0
  std::vector<double> estimates;      ///< estimated local error [m]
  std::vector<double> local_errors;   ///< true local error, see LocalErrors [m]
  std::vector<double> local_unknown;  ///< uncertainty of the true local error [m]
};

/// The accuracy study of one scene.
struct SceneAccuracy {
  std::string name;                        ///< base name of its files
  std::string scene;                       ///< scene file, as given
  std::optional<std::string> digest = {};  ///< SceneSource::digest; absent in files of older versions
  AccuracyOptions options;                 ///< options completed by complete()
  double step = 0;                         ///< the scene's step length [s]
  std::string tolerance_unit = "m";        ///< or "N"

  std::vector<double> apart;            ///< distance of the two references at each time [m]
  std::vector<double> apart_by_step;    ///< the same after every step of the whole motion [m]
  std::optional<double> chaotic_from;   ///< first time with references further apart than smallest_error [s]
  std::optional<double> buckling_from;  ///< first time with references further apart than largest_rounding [s]
  std::optional<double> contact_from;   ///< first time of contact, if before the first of `times` [s]
  double solve_apart = 0;               ///< largest distance of a step's two exact results [m]
  std::int64_t states = 0, left_out = 0;
  double step_reference = 0, step_apart = 0;  ///< see StepReference: step [s], apart [m]
  std::vector<double> step_gained;            ///< see StepReference::gained, at each time [m]
  std::optional<double> film_unknown;  ///< FLIP error between the films of the reference with and without extrapolation

  std::vector<TolerancePoint> points;  ///< sorted by method, then tolerance, in the given order
  std::vector<StepPoint> steps;        ///< sorted by method, then step, in the given order
  std::vector<MotionPoint> asked;      ///< sorted by method, then accuracy, in the given order
  std::vector<MotionPoint> fixed;      ///< sorted by method, then step, in the given order
  std::vector<std::string> notes;      ///< omitted cases, with reasons
};

/// Computes the order of each point from the errors of neighbouring steps.
void find_orders(std::vector<StepPoint>& steps);

/// Smallest error that a study resolves [m].
inline constexpr double smallest_error = 1e-6;

/// Rounding tolerance [m]. Two motions that differ by rounding only, but by more than this, have met an instability
/// that amplifies small errors: the cloth begins to buckle.
inline constexpr double largest_rounding = 1e-8;

/// Iteration limit of a step, high enough that the tolerance decides.
inline constexpr int most_study_iterations = 5000;

/// Returns the number of steps of length h up to a time.
inline std::int64_t steps_until(double time, double h) { return std::llround(time / h); }

/// Fills empty options with the scene's defaults, and rounds times to whole steps.
/// @throws UsageError if a time is outside the motion, or the first time is no multiple of a step
AccuracyOptions complete(AccuracyOptions options, const LoadedScene& scene);

/// Checks that study_accuracy() can run every case of the scene, which it would otherwise find out after hours.
/// @throws UsageError
void check_accuracy(const std::string& file, const AccuracyOptions& options);

/// Measures the accuracy and the cost of a scene's methods. `name` is the base name of its files.
/// @param file  the scene file as given on the command line, relative to the working folder
/// @returns nothing if stopped
/// @throws UsageError, DivergedError
std::optional<SceneAccuracy> study_accuracy(const std::string& name, const std::string& file,
                                            const AccuracyOptions& options, const std::stop_token& stop,
                                            Progress& progress);

struct ToleranceCase {
  StepMethod method;
  double tolerance;
  StudyCase study_case;
};
/// A case with a time step [s] or an accuracy [m].
struct StepCase {
  StepMethod method;
  double setting;
  StudyCase study_case;
};
struct AccuracyCases {
  std::vector<ToleranceCase> tolerances;
  std::vector<StepCase> steps;  ///< each step solved to the end
  std::vector<StepCase> asked;  ///< cases with an accuracy
  std::vector<StepCase> fixed;  ///< cases with a time step and the default tolerance
  /// One of each method that fails only if the method cannot compute the scene with any step.
  std::vector<StudyCase> easiest;
};

/// Removes methods that cannot compute the scene with any step, unless no method would remain.
/// @param notes gets a sentence about each removed method
void leave_out_methods(const LoadedScene& scene, const std::string& file, AccuracyOptions& options,
                       std::vector<std::string>& notes);

/// Returns the cases to measure in a scene.
/// @param file    the scene file as given on the command line
/// @param options completed by complete()
/// @param notes   gets a sentence about each case that cannot be measured
AccuracyCases accuracy_cases(const Scene& scene, const std::string& file, const AccuracyOptions& options,
                             std::vector<std::string>& notes);

}  // namespace drape
