#include "cli/output_clashes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <unordered_map>

#include "core/error.hpp"
#include "core/file_identity.hpp"
#include "core/text.hpp"
#include "run/outputs.hpp"

namespace drape {
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
  explicit Clashes(const std::vector<Scene>& scenes) : scenes_(scenes) {
    for (const Scene& scene : scenes) {
      for (const std::filesystem::path& input : scene.inputs) readers_.emplace(file_identity(input), &scene);
    }
  }

  /// Adds a writer. @returns the first clash of its files; empty if there is none
  std::string add(const Writer& writer) {
    std::string problem;
    for (const std::string& file : writer.files) {
      const std::string identity = file_identity(file);
      const auto reader = readers_.find(identity);
      if (reader != readers_.end()) {
        return fmt::format("{} would overwrite {}, an input of {}", writer.option, file, shown(reader->second->file));
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
    const Scene &first = scenes_[other.scene], &second = scenes_[writer.scene];
    return fmt::format("'{}' would be written for {} and again for {}: {}", file, shown(first.file), shown(second.file),
                       first.name == second.name
                           ? "they have the same name, so render them one at a time, to different files"
                           : "put {scene} into the name");
  }

  const std::vector<Scene>& scenes_;
  std::unordered_map<std::string, const Scene*> readers_;
  std::unordered_map<std::string, Claim> writers_;
};

}  // namespace

void require_distinct_files(const std::vector<Scene>& scenes, const std::vector<RunOptions>& options) {
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
