#pragma once

#include <set>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace drape {

/// Every scene, or the problems of all of them at once.
/// @throws UsageError
std::vector<Scene> load_scenes(const std::vector<std::string>& files, const std::vector<std::string>& overrides);

/// Names that tell scenes apart, each of which can be the name of a file: the scenes' own, with the folder's before it
/// where there are several.
/// @param taken names that no scene may get
std::vector<std::string> unique_names(const std::vector<Scene>& scenes, const std::set<std::string>& taken = {});

}  // namespace drape
