#include "cli/inputs.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <spdlog/spdlog.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "cli/options.hpp"
#include "cli/terminal.hpp"
#include "core/files.hpp"
#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/document.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/settings.hpp"
#include "motion/import/import_motion.hpp"
#include "motion/reader.hpp"
#include "output/registry.hpp"
#include "run/frame_source.hpp"
#include "run/outputs.hpp"
#include "scene/motion_scene.hpp"

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

namespace {

/// Reads every file, then throws the errors of all.
template <class Read>
auto read_each(const std::vector<std::string>& files, const Read& read) {
  std::vector<decltype(read(files.front()))> scenes;
  SceneProblems problems;
  for (const std::string& file : files) {
    try {
      scenes.push_back(read(file));
    } catch (const UsageError& error) {
      problems.add(file, error.what());
    }
  }
  problems.throw_if_any(files);
  return scenes;
}

}  // namespace

std::vector<LoadedScene> load_scenes(const std::vector<std::string>& files, const std::vector<std::string>& overrides) {
  return read_each(files, [&](const std::string& file) { return load_scene(file, overrides); });
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

bool is_motion_file(const std::string& file) {
  const OutputFormat* format = find_format(file);
  return format != nullptr && format->of_steps();
}

namespace {

/// A motion and its unpacked scene.
struct OpenMotion {
  MotionReader reader;
  MotionScene folder;

  explicit OpenMotion(const std::string& file) : reader(file), folder(reader) {}
};

struct GrowingMotion {
  ResumePoint from;
  MotionScene folder;
  LoadedScene scene;

  explicit GrowingMotion(const std::string& file)
      : from(read_resumption(file)), folder(*from.partial), scene(folder.scene()) {}
};

/// Keeps the solver's tolerance: a quality would change it, but the steps of a recorded motion are already solved.
void keep_solver(const LoadedScene& scene, LoadedScene& other) {
  if (other.quality == scene.quality) return;
  for (SceneValue& value : other.source.tables) {
    if (value.key != "integrator.tolerance" && value.key != "integrator.stop") continue;
    const auto own = std::ranges::find(scene.source.tables, value.key, &SceneValue::key);
    if (own != scene.source.tables.end()) value.text = own->text;
  }
}

/// Returns an imported motion's scene with the camera, look and film of another scene, which may have any cloth.
LoadedScene with_look(LoadedScene scene, const LoadedScene& other) {
  scene.camera = other.camera;
  scene.look = other.look;
  scene.video = other.video;
  scene.caption = other.caption;
  scene.source.caption_place = other.source.caption_place;
  scene.overlay = other.overlay;
  scene.source.texture_location = other.source.texture_location;
  if (scene.uvs.empty()) scene.look.texture.clear();
  return scene;
}

/// Returns the scene for drawing a motion: its own, or a replacement.
/// @param file the user's file; its folder has the textures that overrides name
LoadedScene scene_to_draw(const std::string& file, const MotionHeader& header, const MotionScene& unpacked,
                          const std::vector<std::string>& overrides, const std::string& look) {
  LoadedScene scene = unpacked.scene();
  if (header.imported && !look.empty()) {
    scene = with_look(std::move(scene), load_scene(look, overrides));
  } else if (!look.empty() || !overrides.empty()) {
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    LoadedScene other = look.empty() ? unpacked.load(overrides, folder) : load_scene(look, overrides, cells_of(scene));
    keep_solver(scene, other);
    require_same_physics(file, scene, other, look.empty() ? "--set" : look);
    scene = std::move(other);
  }
  if (header.imported) scene.source.fields.clear();  // they do not describe an imported motion
  scene.source.file = file;
  scene.name = scene.source.file.stem().string();
  scene.source.digest = no_scene_digest;
  scene.source.inputs.emplace_back(file);
  return scene;
}

/// Opens a motion for drawing; other parameters as of open_scene().
/// @param motion_file the file, or the motion that was made of it
SceneToRun open_motion(const std::string& motion_file, const std::string& file,
                       const std::vector<std::string>& overrides, const std::string& look) {
  const auto motion = std::make_shared<OpenMotion>(motion_file);
  return {scene_to_draw(file, motion->reader.header(), motion->folder, overrides, look),
          std::shared_ptr<MotionReader>(motion, &motion->reader)};
}

/// A temporary motion file, kept while it is read.
struct ImportedFile {
  TemporaryFolder folder{"drape-import"};
  SceneToRun opened = {};
  std::vector<std::filesystem::path> files = {};  // of the other program
};

/// Imports a motion into a temporary motion file.
/// @param name name of that file
std::shared_ptr<ImportedFile> import_for_now(const ImportOptions& options, const std::string& name,
                                             const std::vector<std::string>& overrides, const std::string& look) {
  auto imported = std::make_shared<ImportedFile>();
  const std::filesystem::path motion = imported->folder.path() / (name + ".drape");
  try {
    run_watched(true, [&](const std::stop_token& stop, Progress& progress) {
      imported->files = import_motion(options, motion, stop, progress).files;
    });
  } catch (const Interrupted&) {
    throw UsageError(shown(options.cloths.front()) + ": interrupted while it was read");
  }
  imported->opened = open_motion(motion.string(), options.cloths.front(), overrides, look);
  return imported;
}

SceneToRun with_scene(const std::shared_ptr<ImportedFile>& imported, LoadedScene scene) {
  scene.source.inputs.insert(scene.source.inputs.end(), imported->files.begin(), imported->files.end());
  return {std::move(scene), std::shared_ptr<MotionReader>(imported, imported->opened.recorded.get())};
}

/// Opens a motion in another program's format.
SceneToRun open_import(const std::string& file, const std::vector<std::string>& overrides, const std::string& look) {
  std::string name = std::filesystem::path(file).stem().string();
  std::erase_if(name, [](char c) { return c == '{' || c == '}' || c == ':'; });
  const auto imported = import_for_now({.cloths = {file}}, name, overrides, look);
  LoadedScene scene = imported->opened.scene;
  scene.source.file = file;
  scene.name = name;
  return with_scene(imported, std::move(scene));
}

/// Opens a scene that refers to a motion.
SceneToRun open_scene_of_motion(const std::string& file, const SceneOfMotion& of_motion) {
  const NamedMotion& named = of_motion.named;
  const LoadedScene& look = of_motion.look;
  const ImportOptions options{.cloths = {named.motion},
                              .bodies = named.bodies,
                              .mesh = named.mesh,
                              .prim = named.prim,
                              .axes = {.y_up = named.y_up, .scale = named.scale},
                              .fps = named.fps};
  std::shared_ptr<ImportedFile> imported;
  try {
    imported = import_for_now(options, look.name, {}, {});
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}: motion: {}", shown(file), error.what()));
  }
  if (!look.look.texture.empty() && imported->opened.scene.uvs.empty()) {
    throw UsageError(look.source.texture_location + ": texture: the motion has no texture coordinates");
  }
  LoadedScene scene = with_look(imported->opened.scene, look);
  scene.check = look.check;
  scene.source.file = look.source.file;
  scene.name = look.name;
  scene.source.digest = look.source.digest;
  scene.source.inputs = look.source.inputs;
  scene.source.warnings = look.source.warnings;
  return with_scene(imported, std::move(scene));
}

}  // namespace

void require_known_values(const std::string& file, const MotionHeader& header, const Scene& drawn) {
  std::vector<std::string> unknown;
  if (drawn.overlay.energies && !header.energies) unknown.emplace_back("[overlay] energies");
  for (const TextTemplate::Piece& piece : drawn.caption.filled.pieces()) {
    const bool known =
        piece.text == "iterations" ? !header.imported : header.energies || !piece.text.starts_with("energy.");
    if (piece.is_field && !known) unknown.push_back("{" + piece.text + "} in the caption");
  }
  if (unknown.empty()) return;
  throw UsageError(fmt::format("{}: another program made this motion without these values: omit {}", shown(file),
                               fmt::join(unknown, ", ")));
}

namespace {

/// Opens as open_scene() does, without its check of what the film shows.
SceneToRun open_any(const std::string& file, const std::vector<std::string>& overrides, const std::string& look) {
  if (file.ends_with(".drape.partial")) {
    throw UsageError(fmt::format("{0} is not complete: drape simulate --resume {0} continues it", file));
  }
  if (is_motion_file(file)) return open_motion(file, file, overrides, look);
  if (is_importable(file)) return open_import(file, overrides, look);
  const TomlValue document = read_document(file);  // once: the file may be a pipe
  if (const auto of_motion = load_scene_of_motion(document, file, overrides)) {
    if (!look.empty())
      throw UsageError(fmt::format("{}: it says itself how its motion looks: omit --scene", shown(file)));
    return open_scene_of_motion(file, *of_motion);
  }
  LoadedScene scene = make_scene(document, file, overrides);
  scene.source.inputs.emplace_back(file);
  return {std::move(scene), nullptr};
}

}  // namespace

SceneToRun open_scene(const std::string& file, const std::vector<std::string>& overrides, const std::string& look) {
  SceneToRun opened = open_any(file, overrides, look);
  if (opened.recorded) require_known_values(file, opened.recorded->header(), opened.scene);
  return opened;
}

std::vector<SceneToRun> open_scenes(const std::vector<std::string>& files, const std::vector<std::string>& overrides) {
  return read_each(files, [&](const std::string& file) { return open_scene(file, overrides); });
}

void warn_of_gaps(const std::string& file, const MotionReader& motion, const FilmExtent& extent) {
  const int between = frames_in_gaps(motion, extent);
  if (between == 0) return;
  spdlog::warn("{}: {} frames lie between stored states more than a step apart and are interpolated", file, between);
}

std::string motion_to_resume(std::string file) {
  constexpr std::string_view ending = ".partial";
  if (file.ends_with(ending)) file.resize(file.size() - ending.size());
  if (is_motion_file(file)) return file;
  throw UsageError(fmt::format("--resume {}: expected the name of a motion file, as in motion.drape", file));
}

std::optional<ResumableRun> find_resumable_run(const std::string& file, const std::vector<std::string>& overrides,
                                               const std::string& look) {
  if (!std::filesystem::exists(growing_name(file)) && std::filesystem::exists(file)) return std::nullopt;
  const auto motion = std::make_shared<GrowingMotion>(file);
  motion->scene.source.file = file;
  const MotionHeader& header = motion->from.partial->header();
  if (const std::string program = this_program(); header.program != program) {
    spdlog::warn("{}: begun by drape {}, but this is drape {}: the bits of the rest may differ", file, header.program,
                 program);
  }
  RunOptions options;
  options.motion = {.path = file, .recorded = header.recorded};
  options.steps = header.steps;
  options.from = std::shared_ptr<const ResumePoint>(motion, &motion->from);
  return ResumableRun{std::shared_ptr<const LoadedScene>(motion, &motion->scene), options,
                      scene_to_draw(file, header, motion->folder, overrides, look)};
}

RecordedSteps parse_every(const std::string& text, double step) {
  if (text == "frames") return {.every = std::nullopt};
  if (is_time(text)) return {.every = steps_in("--every", text, step)};
  std::int64_t every = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, every);
  if (read.ec != std::errc() || read.ptr != end || every < 1 || every > 1'000'000'000) {
    throw UsageError(
        fmt::format("--every takes a number of steps of at least 1, a time such as 0.1s, or frames; found '{}'", text));
  }
  return {.every = every};
}

void require_steps(const std::string& file, std::int64_t last_step, const std::optional<std::int64_t>& steps) {
  if (steps.value_or(0) > last_step) throw UsageError(fmt::format("--steps {}: {} has {}", *steps, file, last_step));
}

void limit_to_motion(const std::string& file, std::int64_t last_step, RunOptions& options) {
  require_steps(file, last_step, options.steps);
  options.steps = options.steps.value_or(last_step);
  const RecordPaths& records = options.records;
  for (const auto& [option, path] :
       {std::pair{"--stats", records.stats}, std::pair{"--energies", records.energies},
        std::pair{"--positions", records.positions}, std::pair{"--trace", records.trace}}) {
    if (path.empty()) continue;
    const std::string remedy =
        is_motion_file(file) ? fmt::format(": use drape simulate --resume {} {} {}", file, option, path) : "";
    throw UsageError(fmt::format("{} needs a simulation, and {} is only read{}", option, file, remedy));
  }
  if (options.motion) throw UsageError(fmt::format("-o {}: {} is already a motion file", options.motion->path, file));
}

}  // namespace drape
