#include "cli/scene_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "core/error.hpp"
#include "core/names_in_folders.hpp"

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

std::vector<std::string> unique_names(const std::vector<Scene>& scenes, const std::set<std::string>& taken) {
  constexpr std::size_t longest = 100;
  std::map<std::string, int> with_this_name;
  for (const Scene& scene : scenes) ++with_this_name[scene.name];
  std::set<std::string> used = taken;
  std::vector<std::string> names;
  for (const Scene& scene : scenes) {
    const std::string folder =
        std::filesystem::absolute(scene.file).lexically_normal().parent_path().filename().string();
    const std::string stem =
        as_name_in_folder(with_this_name[scene.name] > 1 ? folder + "-" + scene.name : scene.name, longest);
    std::string name = stem;
    for (int number = 2; !used.insert(name).second; ++number) name = fmt::format("{}-{}", stem, number);
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace drape
