#pragma once

#include "study/accuracy.hpp"
#include "study/report.hpp"

namespace drape {

/// How the estimates of a motion's steps compare with their true errors.
struct EstimateCheck {
  std::size_t judged = 0;      ///< steps before anything is touched or buckles whose errors matter and are known
  std::size_t close = 0;       ///< of these, those with an estimate within a factor of 3
  double worst_before = 0;     ///< the largest error by its estimate, of these
  double worst_after = 0;      ///< likewise later
  std::size_t after = 0;       ///< how many these are
  std::size_t unknown = 0;     ///< whose true error is not known
  std::size_t missed = 0;      ///< with an error above ten times the accuracy
  std::size_t unreported = 0;  ///< of these, those that said that they were accurate enough

  EstimateCheck& operator+=(const EstimateCheck& other);
};

/// Until when no cloth of a scene has touched anything or buckled, as far as its first time goes [s].
double smooth_until(const SceneAccuracy& scene);

/// An error and an estimate that are both below a tenth of the accuracy are not judged: what is far more accurate than
/// asked need not be known exactly.
EstimateCheck check_estimates(const SceneAccuracy& scene, const MotionPoint& asked);

/// What was asked, and what came: its diagrams and tables.
std::vector<NamedChart> asked_charts(const SceneAccuracy& scene);
std::vector<ResultTable> asked_tables(const SceneAccuracy& scene);
void add_asked_findings(StudyReport& report, const SceneAccuracy& scene);

}  // namespace drape
