#include "cli/scene_files.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

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

std::string shell_word(const std::string& word) {
  constexpr std::string_view harmless = "%+,-./:=@_";
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [&](unsigned char c) {
    return std::isalnum(c) != 0 || harmless.find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace drape
