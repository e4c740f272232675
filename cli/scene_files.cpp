#include "cli/scene_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "core/error.hpp"
#include "core/names_in_folders.hpp"
#include "core/text.hpp"

namespace drape {
void SceneProblems::add(const std::string& file, std::string_view message) {
  for (std::size_t begin = 0; begin <= message.size();) {
    const std::size_t end = std::min(message.find('\n', begin), message.size());
    const std::string_view line = message.substr(begin, end - begin);
    auto found = std::ranges::find(lines_, line, [](const auto& known) -> std::string_view { return known.first; });
    if (found == lines_.end()) found = lines_.insert(found, {std::string(line), {}});
    if (std::ranges::find(found->second, file) == found->second.end()) found->second.push_back(file);
    begin = end + 1;
  }
}

void SceneProblems::throw_if_any(const std::vector<std::string>& files) const {
  const std::set<std::string> all(files.begin(), files.end());
  std::string text;
  for (const auto& [line, of] : lines_) {
    const bool of_values = line.starts_with("--set ") || line.starts_with("--vary ");
    const bool everywhere = !of_values || of.size() == all.size();
    for (const std::string& file : everywhere ? std::vector<std::string>(1) : of) {
      text += (text.empty() ? "" : "\n") + (file.empty() ? "" : escape_controls(file) + ": ") + line;
    }
  }
  if (!text.empty()) throw UsageError(text);
}

std::vector<Scene> load_scenes(const std::vector<std::string>& files, const std::vector<std::string>& overrides) {
  std::vector<Scene> scenes;
  SceneProblems problems;
  for (const std::string& file : files) {
    try {
      scenes.push_back(load_scene(file, overrides));
    } catch (const UsageError& error) {
      problems.add(file, error.what());
    }
  }
  problems.throw_if_any(files);
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
