#pragma once

#include "study/accuracy.hpp"

namespace drape {

struct ToleranceCase {
  StepMethod method;
  double tolerance;
  StudyCase what;
};
struct StepCase {
  StepMethod method;
  double step;
  StudyCase what;
};
struct AccuracyCases {
  std::vector<ToleranceCase> tolerances;
  std::vector<StepCase> steps;
};

/// What is measured in a scene.
/// @param file    the scene's, as a command names it
/// @param options complete
/// @param notes   gets a sentence about everything that cannot be measured
AccuracyCases accuracy_cases(const Scene& scene, const std::string& file, const AccuracyOptions& options,
                             std::vector<std::string>& notes);

}  // namespace drape
