#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "render/backend.hpp"
#include "run/progress.hpp"
#include "study/measure.hpp"
#include "study/reference.hpp"
#include "study/solve_error.hpp"

namespace drape {

/// How many times finer than the smallest step asked for a reference in time is.
inline constexpr std::int64_t reference_refinement = 4;

/// What of a scene is measured.
struct AccuracyParts {
  bool solve = true;      ///< errors of the solve and of the motion, by method and tolerance
  bool order = true;      ///< of the methods in the time step, each step solved to the end
  bool asked = true;      ///< what [time] accuracy gives, beside fixed steps with the default tolerance
  bool estimates = true;  ///< how true what the steps of `asked` say of their errors is; only with that
  bool films = false;     ///< how different the films of these look; needs `asked`

  bool operator==(const AccuracyParts&) const = default;
};
inline constexpr std::array<std::pair<const char*, bool AccuracyParts::*>, 5> accuracy_parts{
    {{"solve", &AccuracyParts::solve},
     {"order", &AccuracyParts::order},
     {"asked", &AccuracyParts::asked},
     {"estimates", &AccuracyParts::estimates},
     {"films", &AccuracyParts::films}}};

/// The parts that are there: "solve,order,asked,estimates".
std::string names_of(const AccuracyParts& parts);

/// What is asked. What is left empty has the defaults that complete() fills in.
struct AccuracyOptions {
  std::vector<StepMethod>
      methods;  ///< empty: all; those but backward Euler take part in the error of the time step only
  std::vector<double> tolerances;  ///< empty: 1, 0.1, … 1e-7 [m] or [N], as the scene's stopping rule has it
  std::vector<double> steps;       ///< empty: the scene's step and its halves [s]
  std::vector<double> times;       ///< of the motion's error; empty: 1/20, 1/8 and 1/4 of the scene's duration [s]
  std::vector<double> accuracies;  ///< asked for; empty: 1e-2, 1e-3, 1e-4 [m]
  std::vector<std::string> overrides;
  RunCount runs = {};
  double patience = 20;  ///< after so much computing time a motion of `asked` is given up [s]
  AccuracyParts parts = {};
  GlBackend backend = GlBackend::automatic;  ///< of the films
  bool of_several_scenes = false;            ///< a method that cannot compute one of them is left out there
};

/// What is kept of a case that was measured.
struct CaseRuns {
  StudyCase what;
  double step = 0;                   ///< h [s]
  double iterations = 0;             ///< mean of a step
  std::int64_t capped = 0;           ///< steps that ended at the cap
  double flipped_pairs = 0;          ///< mean over the steps that were watched, see FlippedPairs
  std::vector<double> microseconds;  ///< mean over the steps, of every timed run, as computing time
  std::vector<double> setup;         ///< likewise, before the first step
  std::string failure;               ///< why it has not come to its end; empty: it has

  CaseRuns() = default;
  explicit CaseRuns(const Measured& measured);
  [[nodiscard]] MedianInterval time() const { return median_interval(microseconds); }
  /// Computing time for a second of motion, with its share of the set-up: who chooses steps has that work before the
  /// first, and who asks for an accuracy in several of them [ms].
  [[nodiscard]] MedianInterval cost() const;
};

/// A method with a tolerance.
struct TolerancePoint {
  StepMethod method = Method::implicit;
  double tolerance = 0;
  CaseRuns measured;
  SolveError solve;
  std::vector<Distance> motion;  ///< to the reference at every time
};

/// A method with a time step.
struct StepPoint {
  StepMethod method = Method::implicit;
  double step = 0;  ///< h [s]
  CaseRuns measured;
  Distance error;    ///< at the first time
  double order = 0;  ///< measured between this step and the next larger one; not a number for the largest
};

/// A method with an accuracy that was asked for, or with a time step and the default tolerance.
struct MotionPoint {
  StepMethod method = Method::implicit;
  double setting = 0;  ///< the accuracy [m], or h [s]
  CaseRuns measured;
  std::vector<Distance> errors;   ///< to the reference in small steps at every time; not a number: it failed before
  std::optional<double> flip;     ///< FLIP error of the film, see FilmJudge; absent: there is none
  std::vector<double> film_flip;  ///< of each of its frames
  // Of every step up to the first time, where an accuracy was asked for:
  std::vector<double> substeps;       ///< that it was cut into
  std::vector<double> converged;      ///< 1 where it did
  std::vector<double> estimates;      ///< of the error that it added [m]
  std::vector<double> local_errors;   ///< what that was, see LocalErrors [m]
  std::vector<double> local_unknown;  ///< how well that is known [m]
};

/// What accuracy costs in one scene.
struct SceneAccuracy {
  std::string name;                  ///< of its files
  std::string scene;                 ///< its file, as it was given
  AccuracyOptions options;           ///< complete
  double step = 0;                   ///< of the scene [s]
  std::string tolerance_unit = "m";  ///< or "N"

  std::vector<double> apart;            ///< of the two references at every time [m]
  std::vector<double> apart_by_step;    ///< after every step of the whole motion
  std::optional<double> chaotic_from;   ///< when the two references part by more than smallest_error [s]
  std::optional<double> buckling_from;  ///< when they part by more than rounding does [s]
  std::optional<double> contact_from;   ///< when something is first touched, if that is before the first time [s]
  double solve_apart = 0;               ///< of the two exact results of a step, at most [m]
  std::int64_t states = 0, left_out = 0;
  double step_reference = 0, step_apart = 0;  ///< see StepReference
  std::vector<double> step_gained;            ///< likewise, at every time
  std::optional<double> film_unknown;         ///< FLIP error of the reference's film with its less accurate half

  std::vector<TolerancePoint> points;  ///< by method, then tolerance as given
  std::vector<StepPoint> steps;        ///< by method, then step as given
  std::vector<MotionPoint> asked;      ///< by method, then accuracy as given
  std::vector<MotionPoint> fixed;      ///< by method, then step as given
  std::vector<std::string> notes;      ///< what was left out, and why
};

/// Finds the orders of steps from their errors.
void find_orders(std::vector<StepPoint>& steps);

/// The smallest error that a study tells apart [m].
inline constexpr double smallest_error = 1e-6;

/// Two motions that differ by rounding alone and are further apart than this have met something that magnifies what is
/// small: the cloth has begun to buckle [m].
inline constexpr double largest_rounding = 1e-8;

/// Iterations after which a step is given up, whatever the method: the tolerance is to decide.
inline constexpr int most_study_iterations = 5000;

/// How many steps end at a time [s].
inline std::int64_t steps_until(double time, double h) { return std::llround(time / h); }

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
