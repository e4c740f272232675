#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/result_table.hpp"
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

/// A method with a tolerance or a step, its error and its cost.
struct Offer {
  std::string method, at;  ///< "liu13", "ε = 0.001"
  double error = 0;        ///< [m]
  MedianInterval cost;     ///< cost, in the same unit for all offers
};

/// The cheapest offer with an error below a limit, and the cheapest of another method; null if there is none.
struct Cheapest {
  const Offer* first = nullptr;
  const Offer* next = nullptr;
};
Cheapest find_cheapest(const std::vector<Offer>& offers, double limit);

/// Returns the offers of all tolerances, with the error of a single step.
std::vector<Offer> solve_offers(const SceneAccuracy& scene);

/// Returns the answer for the first kind of error that the study knows, as a sentence: "Below 1 mm, liu13 at h = 0.001
/// s costs least: 40.1 ms per second of motion (whole, at 0.4 s)". Empty if nothing was measured.
std::string first_answer(const SceneAccuracy& scene);

/// Returns the study's answer: the cheapest method, its setting and cost, by kind and size of error.
ResultTable answer_table(const SceneAccuracy& scene);

/// Returns the same with the second cheapest method, one row each.
ResultTable cheapest_table(const SceneAccuracy& scene);

/// Returns "The cheapest below 1 mm is liu13 at ε = 0.001 m with 88.1 µs per step; below 0.1 mm it is …"
std::string describe_cheapest(const SceneAccuracy& scene);

/// A comparison of estimated and true errors of a motion's steps.
struct EstimateCheck {
  std::size_t judged = 0;      ///< steps before first contact or buckling with a known and relevant error
  std::size_t close = 0;       ///< judged steps with an estimate within a factor of 3
  double worst_before = 0;     ///< largest ratio of error to estimate in judged steps
  double worst_after = 0;      ///< the same ratio in later steps
  std::size_t after = 0;       ///< number of later steps
  std::size_t unknown = 0;     ///< steps with an unknown true error
  std::size_t missed = 0;      ///< steps with an error above ten times the accuracy
  std::size_t unreported = 0;  ///< missed steps that reported convergence

  EstimateCheck& operator+=(const EstimateCheck& other);
};

/// Returns the time until which no vertex of the cloth touches anything or buckles, up to the first of `times` [s].
double smooth_until(const SceneAccuracy& scene);

/// Compares the estimates with the true errors of a motion's steps. Skips a step whose error and estimate are both
/// below a tenth of the accuracy: far better than required need not be estimated well.
EstimateCheck check_estimates(const SceneAccuracy& scene, const MotionPoint& asked);

/// Returns the diagrams that compare requested and achieved accuracy; the tables and findings follow.
std::vector<NamedChart> asked_charts(const SceneAccuracy& scene);
std::vector<ResultTable> asked_tables(const SceneAccuracy& scene);
void add_asked_findings(StudyReport& report, const SceneAccuracy& scene);

}  // namespace drape
