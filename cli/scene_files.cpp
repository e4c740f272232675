#include "cli/scene_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <spdlog/spdlog.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/files.hpp"
#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "run/outputs.hpp"

namespace drape {

void open_file(const std::string& what) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  }
  std::string program = "xdg-open", argument = what;
  if (argument.starts_with('-')) argument.insert(0, "./");
  const std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
  std::vector<std::string> variables = environment_for_others();
  std::vector<char*> environment;
  for (std::string& variable : variables) environment.push_back(variable.data());
  environment.push_back(nullptr);
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    spdlog::warn("cannot open {}: there is no xdg-open; on Debian: apt-get install xdg-utils", shown(what));
}

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

std::vector<LoadedScene> load_scenes(const std::vector<std::string>& files, const std::vector<std::string>& overrides) {
  std::vector<LoadedScene> scenes;
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

std::vector<std::string> unique_names(const std::vector<LoadedScene>& scenes, const std::set<std::string>& taken) {
  constexpr std::size_t longest = 100;
  std::map<std::string, int> with_this_name;
  for (const Scene& scene : scenes) ++with_this_name[scene.name];
  std::set<std::string> used = taken;
  std::vector<std::string> names;
  for (const LoadedScene& scene : scenes) {
    const std::string folder =
        std::filesystem::absolute(scene.source.file).lexically_normal().parent_path().filename().string();
    const std::string stem =
        as_name_in_folder(with_this_name[scene.name] > 1 ? folder + "-" + scene.name : scene.name, longest);
    std::string name = stem;
    for (int number = 2; !used.insert(name).second; ++number) name = fmt::format("{}-{}", stem, number);
    names.push_back(std::move(name));
  }
  return names;
}

namespace {

/// An option that writes files.
struct Writer {
  std::size_t scene;
  std::string option;              ///< as given: "-o x.png"
  std::vector<std::string> files;  ///< files to be written
};

std::vector<Writer> writers(std::size_t number, const Scene& scene, const RunOptions& options) {
  std::vector<Writer> result;
  const FilmInfo film = film_info(scene, options);
  for (const std::string& path : options.outputs) {
    result.push_back({number, "-o " + path, output_files(path, film)});
  }
  for (const std::string& path : options.poster ? options.outputs : std::vector<std::string>()) {
    result.push_back({number, "the poster of " + path, poster_files({path}, film)});
  }
  if (options.motion) {
    const std::string& path = options.motion->path;
    result.push_back({number, "-o " + path, {path, growing_name(path).string(), checkpoint_name(path).string()}});
  }
  const RecordPaths& r = options.records;
  for (const auto& [option, file] : {std::pair{"--stats", r.stats}, std::pair{"--energies", r.energies},
                                     std::pair{"--positions", r.positions}, std::pair{"--trace", r.trace}}) {
    if (!file.empty()) result.push_back({number, fmt::format("{} {}", option, file), {file}});
  }
  return result;
}

class Clashes {
 public:
  explicit Clashes(const std::vector<LoadedScene>& scenes) : scenes_(scenes) {
    for (const LoadedScene& scene : scenes) {
      for (const std::filesystem::path& input : scene.source.inputs) readers_.emplace(file_identity(input), &scene);
    }
  }

  /// Adds a writer. @returns the first clash of its files; empty if there is none
  std::string add(const Writer& writer) {
    std::string problem;
    for (const std::string& file : writer.files) {
      const std::string identity = file_identity(file);
      const auto reader = readers_.find(identity);
      if (reader != readers_.end()) {
        return fmt::format("{} would overwrite {}, an input of {}", writer.option, file,
                           shown(reader->second->source.file));
      }
      const auto [other, free] = writers_.emplace(identity, Claim{writer.scene, writer.option, file});
      if (!free && problem.empty()) problem = describe(writer, file, other->second);
    }
    return problem;
  }

 private:
  struct Claim {
    std::size_t scene;
    std::string option, file;
  };

  [[nodiscard]] std::string describe(const Writer& writer, const std::string& file, const Claim& other) const {
    if (writer.scene == other.scene) {
      return fmt::format("{} and {} write the same file{}", other.option, writer.option,
                         file == other.file ? "" : fmt::format(": {} is {}", file, other.file));
    }
    const LoadedScene &first = scenes_[other.scene], &second = scenes_[writer.scene];
    return fmt::format(
        "'{}' would be written for {} and again for {}: {}", file, shown(first.source.file), shown(second.source.file),
        first.name == second.name ? "they have the same name, so render them one at a time, to different files"
                                  : "put {scene} into the name");
  }

  const std::vector<LoadedScene>& scenes_;
  std::unordered_map<std::string, const LoadedScene*> readers_;
  std::unordered_map<std::string, Claim> writers_;
};

}  // namespace

void require_distinct_files(const std::vector<LoadedScene>& scenes, const std::vector<RunOptions>& options) {
  Clashes clashes(scenes);
  std::string problems;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    for (const Writer& writer : writers(i, scenes[i], options[i])) {
      const std::string problem = clashes.add(writer);
      if (!problem.empty()) problems += (problems.empty() ? "" : "\n") + problem;
    }
  }
  if (!problems.empty()) throw UsageError(problems);
}

}  // namespace drape
