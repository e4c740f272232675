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

/// A method, with its tolerance or its step, that keeps an error below a limit, and what that costs.
struct Offer {
  std::string method, at;  ///< "liu13", "ε = 0.001"
  double error = 0;        ///< [m]
  MedianInterval cost;     ///< in the same unit for all
};

/// The cheapest offer whose error is below the limit, and the cheapest of another method; null where there is none.
struct Cheapest {
  const Offer* first = nullptr;
  const Offer* next = nullptr;
};
Cheapest find_cheapest(const std::vector<Offer>& offers, double limit);

}  // namespace drape
