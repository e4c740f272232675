#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace drape {

/// A key in which scenes differ, and what each of them has.
struct KeyDifference {
  std::string key;                  ///< "integrator.method"
  std::vector<std::string> values;  ///< by scene; "–" where it has no such key
};

/// Every such key, given or not. What a comparison takes from its first scene alone does not count: camera, film, and
/// what stands beside the picture.
std::vector<KeyDifference> differences(const std::vector<Scene>& scenes);

/// What tells each scene from the others, in words: "liu13, tolerance = 0.001". Their names, where these differ or
/// nothing else does.
std::vector<std::string> labels(const std::vector<Scene>& scenes, const std::vector<KeyDifference>& differences);

}  // namespace drape
