#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drape/scene/scene.hpp"
#include "run/run_scene.hpp"

namespace drape {

/// Opens a file or an address in its desktop application with xdg-open, without waiting. Warns if there is none.
void open_file(const std::string& what);

/// Collector of the problems of several scenes, each line once. A line about --set or --vary starts with its scene,
/// unless it applies to all of them.
class SceneProblems {
 public:
  /// @param message a line for each problem, as load_scene() throws it
  void add(const std::string& file, std::string_view message);

  /// @param files all scenes
  /// @throws UsageError that lists the problems, if there are any
  void throw_if_any(const std::vector<std::string>& files) const;

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> lines_;  // lines, each with its scenes
};

/// Loads all scenes and reports all of their problems at once.
/// @throws UsageError
std::vector<LoadedScene> load_scenes(const std::vector<std::string>& files, const std::vector<std::string>& overrides);

/// Returns unique names for scenes, valid as file names: their own names, prefixed by the folder if ambiguous.
/// @param taken reserved names
std::vector<std::string> unique_names(const std::vector<LoadedScene>& scenes, const std::set<std::string>& taken = {});

/// Checks that no file is written twice, and that no input is overwritten. Files are compared by identity, not by name.
/// @param options of each scene
/// @throws UsageError that lists all such files
void require_distinct_files(const std::vector<LoadedScene>& scenes, const std::vector<RunOptions>& options);

}  // namespace drape
