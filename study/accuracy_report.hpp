#pragma once

#include "study/accuracy.hpp"
#include "study/report.hpp"

namespace drape {

/// The study of some scenes as it is printed and written.
/// @param command  that makes it again
/// @param pictures of each scene, its animations; as many as scenes
/// @param seconds  that it took
StudyReport accuracy_report(const std::vector<SceneAccuracy>& scenes, const std::string& command,
                            const std::vector<std::vector<StudyPicture>>& pictures, double seconds);

/// A method, with its tolerance or its step, that keeps an error below a limit, and what that costs.
struct Offer {
  std::string method, at;  ///< "liu13", "ε = 0.001"
  double error = 0;        ///< [m]
  Quartiles cost;          ///< in the same unit for all
};

/// The cheapest offer whose error is below the limit, and the cheapest of another method; null where there is none.
struct Cheapest {
  const Offer* first = nullptr;
  const Offer* next = nullptr;
};
Cheapest find_cheapest(const std::vector<Offer>& offers, double limit);

}  // namespace drape
