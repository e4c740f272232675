#pragma once

#include "study/report.hpp"
#include "study/validation.hpp"

namespace drape {

/// A report that says whether each case's answers are met by its scene, beside the error of the defaults and the
/// computing time.
StudyReport validation_report(const ValidationStudy& study);

/// The outcome of a case.
struct ValidationVerdict {
  bool met = false;             ///< every answer is within its tolerance
  int answers = 0, missed = 0;  ///< that were measured, and of them those beyond their tolerance or without a value
  double worst = 0;             ///< largest |measured − value|/tolerance
  std::string worst_problem, worst_answer;
  double seconds = 0;  ///< computing time of all problems
};

/// @param factor scene_factor or default_factor
ValidationVerdict verdict_of(const ValidationStudy& study, const ValidationCase& of, const std::string& factor);

/// Returns true if every case that was measured is met.
bool all_met(const ValidationStudy& study);

}  // namespace drape
