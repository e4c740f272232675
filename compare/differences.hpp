#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace drape {

/// A key with different values in some scenes.
struct KeyDifference {
  std::string key;                  ///< "integrator.method"
  std::vector<std::string> values;  ///< values by scene; "–" for a missing key
};

/// Returns the keys that differ, given or by default. Excludes keys that a comparison takes from its first scene:
/// camera, film, caption and overlay.
std::vector<KeyDifference> differences(const std::vector<Scene>& scenes);

/// Returns a label for each scene that tells it from the others: "liu13, tolerance = 0.001". Uses the scenes' names if
/// they differ, or if nothing else does.
std::vector<std::string> labels(const std::vector<Scene>& scenes, const std::vector<KeyDifference>& differences);

}  // namespace drape
