#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace drape {

/// Every scene, or the problems of all of them at once.
/// @throws UsageError
std::vector<Scene> load_scenes(const std::vector<std::string>& files, const std::vector<std::string>& overrides);

/// A word as a shell takes it for one: between quotes if it has to be.
std::string shell_word(const std::string& word);

}  // namespace drape
