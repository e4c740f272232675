#pragma once

#include "study/accuracy.hpp"
#include "study/report.hpp"

namespace drape {

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
