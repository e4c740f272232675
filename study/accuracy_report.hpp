#pragma once

#include "study/accuracy.hpp"
#include "study/report.hpp"

namespace drape {

/// The study of some scenes: all that its report is made of.
struct AccuracyStudy {
  std::string command;  ///< that makes it again
  std::vector<SceneAccuracy> scenes;
  std::vector<std::vector<StudyPicture>> pictures;  ///< of each scene, its animations; as many as scenes
  double seconds = 0;                               ///< that it took
  std::vector<std::pair<std::string, std::string>> provenance =
      {};  ///< what it was measured on, see study_provenance()
};

/// The study as it is printed and written.
StudyReport accuracy_report(const AccuracyStudy& study);

}  // namespace drape
