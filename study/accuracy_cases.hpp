#pragma once

#include "study/accuracy.hpp"

namespace drape {

struct ToleranceCase {
  StepMethod method;
  double tolerance;
  StudyCase what;
};
/// A case with a time step [s] or an accuracy [m].
struct StepCase {
  StepMethod method;
  double setting;
  StudyCase what;
};
struct AccuracyCases {
  std::vector<ToleranceCase> tolerances;
  std::vector<StepCase> steps;  ///< each step solved to the end
  std::vector<StepCase> asked;  ///< cases with an accuracy
  std::vector<StepCase> fixed;  ///< cases with a time step and the default tolerance
};

/// Removes methods that cannot compute the scene with any step, unless no method would remain.
/// @param notes gets a sentence about each removed method
void leave_out_methods(const Scene& scene, const std::string& file, AccuracyOptions& options,
                       std::vector<std::string>& notes);

/// Returns the cases to measure in a scene.
/// @param file    the scene file as given on the command line
/// @param options completed by complete()
/// @param notes   gets a sentence about each case that cannot be measured
AccuracyCases accuracy_cases(const Scene& scene, const std::string& file, const AccuracyOptions& options,
                             std::vector<std::string>& notes);

}  // namespace drape
