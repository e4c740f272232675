#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace drape {

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

}  // namespace drape
