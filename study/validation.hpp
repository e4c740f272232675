#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "run/progress.hpp"
#include "run/shard.hpp"
#include "study/motions.hpp"

namespace drape {

struct StudyReport;

/// A known value of a problem.
struct KnownAnswer {
  std::string name;      ///< "drop": name of the measured quantity, also in a file of answers
  std::string curve;     ///< curve of the case on which the answer lies
  double x = 0;          ///< position on the curve
  double value = 0;      ///< the answer
  double tolerance = 0;  ///< largest accepted |measured − value|
};

/// A problem of a case: the case's scene with a few overrides.
struct ValidationProblem {
  std::string name;  ///< "gamma-10"
  std::vector<std::string> overrides;
  std::map<std::string, double> given;  ///< numbers for the measure, with those of the case
  std::vector<KnownAnswer> answers;
};

/// A quantity as a function of the case's parameter.
struct ValidationCurve {
  std::string name, title;  ///< "drop", "tip drop / L"
  std::string how;          ///< method of measurement, one sentence
};

/// A variation of a problem: another cell, step, method or mesh.
struct ValidationVariant {
  std::string name;    ///< "1/20", "liu13"
  std::string method;  ///< name of a step method if the factor is the method; empty: the scene's
  std::vector<std::string> overrides;
};

/// Variants of one problem in one factor.
struct ValidationFactor {
  std::string factor;   ///< "cell", "step", "method", "mesh"
  std::string problem;  ///< the problem's name
  std::vector<ValidationVariant> variants;
};

/// A case of scenes/validation: a question with a known answer.
struct ValidationCase {
  std::string name;                            ///< folder name: "heavy-cantilever"
  std::string title;                           ///< "Heavy cantilever"
  std::string question, theory, source, mesh;  ///< sentences
  std::string scene;                           ///< relative to the data folder
  std::string measure;                         ///< see measure_motion()
  std::string x_title;                         ///< title of the curves' parameter
  bool only_end = false;                       ///< the measure needs only the last state
  std::optional<double> rest_speed;            ///< a run ends once all vertices are slower [m/s]
  double rest_after = 0;                       ///< earliest end by rest_speed [s]
  std::map<std::string, double> given;         ///< numbers shared by all problems
  std::vector<ValidationCurve> curves;         ///< at least one
  std::vector<std::string> default_overrides;  ///< remove the keys for the numerical method from the scene
  std::vector<ValidationProblem> problems;     ///< at least one
  std::vector<std::string> quick;              ///< problems of the quick form
  std::vector<std::string> quick_overrides;    ///< overrides of the quick form, usually a coarser mesh
  std::vector<ValidationFactor> factors;

  /// Returns a problem by name. @throws UsageError with the nearest name
  [[nodiscard]] const ValidationProblem& problem(const std::string& called) const;
};

/// Reads a case.json.
/// @param scene_folder folder of its scene, relative to the data folder
/// @throws UsageError "file: message"
ValidationCase read_validation_case(const std::filesystem::path& file, const std::string& scene_folder);

/// Returns the cases of the data folder, by name.
/// @param names of the wanted cases; empty: all
/// @throws UsageError also for an unknown name
std::vector<ValidationCase> validation_cases(const std::vector<std::string>& names = {});

/// Factors of the runs with the original scene, and without its keys for the numerical method.
inline constexpr const char* scene_factor = "scene";
inline constexpr const char* default_factor = "default";

/// One run of one problem, with its measurements.
struct ValidationRun {
  std::string name;                        ///< name of its case
  std::string problem;                     ///< name of the problem in its case
  std::string factor;                      ///< scene_factor, default_factor, "cell", "step", "method", "mesh"
  std::string setting;                     ///< name of the variant; for a factor without variants, the factor
  StudyCase study_case;                    ///< the command that runs it
  std::optional<std::int64_t> place = {};  ///< position in the plan of all shards; absent without shards

  // Measurements:
  bool measured = false;
  std::string failure;  ///< reason for missing values; empty: none missing
  double seconds = 0;   ///< CPU time with setup [s]
  double step = 0;      ///< step length h [s]
  double cell = 0;      ///< mean spring length [m]
  std::int64_t vertices = 0;
  std::int64_t capped = 0;         ///< number of steps that reached the iteration limit
  double rest_speed = 0;           ///< speed of the fastest vertex at the end [m/s]
  std::vector<std::string> names;  ///< names of the quantities
  std::vector<double> values;      ///< values of the quantities
  html::PlayedMotion played = {};  ///< only for the first problem of --quick with the original scene

  [[nodiscard]] std::optional<double> value(const std::string& quantity) const;
};

/// The options of a study.
struct ValidationOptions {
  std::vector<std::string> cases = {};    ///< empty: all
  std::vector<std::string> methods = {};  ///< methods for the runs that vary the method; empty: all of the case
  bool quick = false;                     ///< a few problems with their original scenes only
  int jobs = 1;                           ///< parallel runs
  double patience = 30;                   ///< computing time limit of a run [s]
  Shard shard = {};                       ///< plan only these runs
};

/// All measurements of a study.
struct ValidationStudy {
  std::vector<ValidationCase> cases;
  std::vector<ValidationRun> runs;  ///< runs in the order of the plan
  std::string command;              ///< options that decide its results: a study continues only one with the same
  std::string typed_command = {};   ///< command line as typed; empty: `command`
  std::vector<std::pair<std::string, std::string>> provenance;
  double seconds = 0;
  Shard shard = {};         ///< the shard of its runs
  std::size_t planned = 0;  ///< number of planned runs; 0: unknown, in files of older versions

  /// Returns the number of planned runs that are not measured.
  [[nodiscard]] std::size_t missing() const;

  /// Returns the measured run of a problem with a factor; null if there is none.
  [[nodiscard]] const ValidationRun* run(const std::string& name, const std::string& problem,
                                         const std::string& factor = scene_factor) const;
};

/// Plans the runs: every problem with its original scene and with defaults, and variants of one factor at a time.
/// Shards have about equal cost, measured in steps times vertices.
/// @throws UsageError for an unknown case or method, or an invalid scene
ValidationStudy plan_validation(const ValidationOptions& options);

/// Measures the remaining runs.
/// @param save called after every run, by one thread at a time
/// @returns false if stopped
bool measure_validation(ValidationStudy& study, const ValidationOptions& options, const std::stop_token& stop,
                        Progress& progress, const std::function<void()>& save);

/// Returns the distance of a value from an answer, in tolerances.
double in_tolerances(const KnownAnswer& answer, double value);

/// The outcome of a case.
struct ValidationVerdict {
  bool met = false;             ///< every answer is within its tolerance
  int answers = 0, missed = 0;  ///< measured answers; of these, those without a value or beyond their tolerance
  double worst = 0;             ///< largest |measured − value|/tolerance
  std::string worst_problem, worst_answer;
  double seconds = 0;  ///< CPU time of all problems
};

/// Returns the outcome of a case for scene_factor or default_factor.
ValidationVerdict verdict_of(const ValidationStudy& study, const ValidationCase& of, const std::string& factor);

/// Returns true if every measured case is met.
bool all_met(const ValidationStudy& study);

/// Returns a report on whether each case's scene meets its answers, with the errors of the defaults and computing
/// times.
StudyReport validation_report(const ValidationStudy& study);

}  // namespace drape
