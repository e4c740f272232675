#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace drape {

/// What is wrong with several scenes, each line once. A line about --set or --vary begins with the scene that it is
/// about, unless it is about all of them.
class SceneProblems {
 public:
  /// @param message of a line for each problem, as load_scene() throws it
  void add(const std::string& file, std::string_view message);

  /// @param files all scenes
  /// @throws UsageError that lists the problems, if there are any
  void throw_if_any(const std::vector<std::string>& files) const;

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> lines_;  // and the scenes that each is about
};

/// Every scene, or the problems of all of them at once.
/// @throws UsageError
std::vector<Scene> load_scenes(const std::vector<std::string>& files, const std::vector<std::string>& overrides);

/// Names that tell scenes apart, each of which can be the name of a file: the scenes' own, with the folder's before it
/// where there are several.
/// @param taken names that no scene may get
std::vector<std::string> unique_names(const std::vector<Scene>& scenes, const std::set<std::string>& taken = {});

}  // namespace drape
