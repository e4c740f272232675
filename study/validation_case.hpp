#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace drape {

/// A known value of a problem.
struct KnownAnswer {
  std::string name;      ///< "drop": what a measure finds, and what a file of answers calls it
  std::string curve;     ///< of the case's curves, that it lies on
  double x = 0;          ///< its place on the curve
  double value = 0;      ///< the answer
  double tolerance = 0;  ///< largest accepted |measured − value|
};

/// A problem of a case: the case's scene with a few values replaced.
struct ValidationProblem {
  std::string name;  ///< "gamma-10"
  std::vector<std::string> overrides;
  std::map<std::string, double> given;  ///< numbers that the measure needs, those of the case included
  std::vector<KnownAnswer> answers;
};

/// A quantity against the case's parameter.
struct ValidationCurve {
  std::string name, title;  ///< "drop", "tip drop / L"
  std::string how;          ///< how it is measured, in a sentence
};

/// One way to run a problem otherwise: another cell, step, method or mesh.
struct ValidationVariant {
  std::string name;    ///< "1/20", "liu13"
  std::string method;  ///< a step method's name where the factor is the method; empty: the scene's
  std::vector<std::string> overrides;
};

/// Variants in one factor of one problem.
struct ValidationFactor {
  std::string factor;   ///< "cell", "step", "method", "mesh"
  std::string problem;  ///< the problem's name
  std::vector<ValidationVariant> variants;
};

/// A case of scenes/validation: a question whose answer is known.
struct ValidationCase {
  std::string name;                            ///< of its folder: "heavy-cantilever"
  std::string title;                           ///< "Heavy cantilever"
  std::string question, theory, source, mesh;  ///< sentences
  std::string scene;                           ///< relative to the data folder
  std::string measure;                         ///< see measure_motion()
  std::string x_title;                         ///< of the curves' parameter
  bool only_end = false;                       ///< the measure needs the last state alone
  std::optional<double> rest_speed;            ///< a run ends once no vertex is faster [m/s]
  double rest_after = 0;                       ///< not before this time [s]
  std::map<std::string, double> given;         ///< numbers that every problem has
  std::vector<ValidationCurve> curves;         ///< at least one
  std::vector<std::string> default_overrides;  ///< take every key about how to compute out of the scene
  std::vector<ValidationProblem> problems;     ///< at least one
  std::vector<std::string> quick;              ///< names of the problems of the quick form
  std::vector<std::string> quick_overrides;    ///< which it replaces in their scenes, as a rule by a coarser mesh
  std::vector<ValidationFactor> factors;

  /// @throws UsageError with the nearest name
  [[nodiscard]] const ValidationProblem& problem(const std::string& called) const;
};

/// Reads a case.json.
/// @param scene_folder the folder of its scene, relative to the data folder
/// @throws UsageError "file: message"
ValidationCase read_validation_case(const std::filesystem::path& file, const std::string& scene_folder);

/// The cases of the data folder, by name.
/// @param names of those that are wanted; empty: all
/// @throws UsageError also for an unknown name
std::vector<ValidationCase> validation_cases(const std::vector<std::string>& names = {});

}  // namespace drape
