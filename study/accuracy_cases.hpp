#pragma once

#include "study/accuracy.hpp"

namespace drape {

struct ToleranceCase {
  StepMethod method;
  double tolerance;
  StudyCase what;
};
/// With a time step [s], or an accuracy [m].
struct StepCase {
  StepMethod method;
  double setting;
  StudyCase what;
};
struct AccuracyCases {
  std::vector<ToleranceCase> tolerances;
  std::vector<StepCase> steps;  ///< each solved to the end
  std::vector<StepCase> asked;  ///< with an accuracy
  std::vector<StepCase> fixed;  ///< with a time step and the default tolerance
};

/// Takes out of the options the methods that cannot compute the scene whatever the step, unless none can.
/// @param notes gets a sentence about each
void leave_out_methods(const Scene& scene, const std::string& file, AccuracyOptions& options,
                       std::vector<std::string>& notes);

/// What is measured in a scene.
/// @param file    the scene's, as a command names it
/// @param options complete
/// @param notes   gets a sentence about everything that cannot be measured
AccuracyCases accuracy_cases(const Scene& scene, const std::string& file, const AccuracyOptions& options,
                             std::vector<std::string>& notes);

}  // namespace drape
