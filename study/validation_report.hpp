#pragma once

#include "study/report.hpp"
#include "study/validation.hpp"

namespace drape {

/// Returns a report on whether each case's scene meets its answers, with the errors of the defaults and computing
/// times.
StudyReport validation_report(const ValidationStudy& study);

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

}  // namespace drape
