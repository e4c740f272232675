#include "cli/scene_files.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "core/error.hpp"

namespace drape {

std::vector<Scene> load_scenes(const std::vector<std::string>& files, const std::vector<std::string>& overrides) {
  std::vector<Scene> scenes;
  std::string problems;
  for (const std::string& file : files) {
    try {
      scenes.push_back(load_scene(file, overrides));
    } catch (const UsageError& error) {
      problems += (problems.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  if (!problems.empty()) throw UsageError(problems);
  return scenes;
}

std::vector<std::string> unique_names(const std::vector<Scene>& scenes) {
  std::map<std::string, int> with_this_name, used;
  for (const Scene& scene : scenes) ++with_this_name[scene.name];
  std::vector<std::string> names;
  for (const Scene& scene : scenes) {
    std::string name = scene.name;
    const std::string folder = std::filesystem::absolute(scene.file).parent_path().filename().string();
    if (with_this_name[name] > 1) name = folder + "-" + name;
    if (const int number = ++used[name]; number > 1) name += fmt::format("-{}", number);
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace drape
