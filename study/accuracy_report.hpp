#pragma once

#include "study/accuracy.hpp"
#include "study/report.hpp"

namespace drape {

/// An accuracy study of several scenes, complete for its report.
struct AccuracyStudy {
  std::string command;  ///< command to reproduce it
  std::vector<SceneAccuracy> scenes;
  std::vector<std::vector<StudyPicture>> pictures;                   ///< animations of each scene; same size as scenes
  double seconds = 0;                                                ///< duration of the study
  std::vector<std::pair<std::string, std::string>> provenance = {};  ///< program and machine, see study_provenance()
};

/// Returns the report of a study for all output formats.
StudyReport accuracy_report(const AccuracyStudy& study);

}  // namespace drape
