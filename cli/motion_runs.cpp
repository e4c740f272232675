#include "cli/motion_runs.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <charconv>
#include <filesystem>

#include "cli/run_arguments.hpp"
#include "cli/scene_files.hpp"
#include "cli/terminal.hpp"
#include "core/files.hpp"
#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/settings.hpp"
#include "motion/import/import_motion.hpp"
#include "motion/reader.hpp"
#include "output/registry.hpp"
#include "run/frame_player.hpp"
#include "scene/motion_scene.hpp"

namespace drape {
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
LoadedScene scene_to_draw(const std::string& file, const MotionHeader& header, const MotionScene& folder,
                          const std::vector<std::string>& overrides, const std::string& look) {
  LoadedScene scene = folder.scene();
  if (header.imported && !look.empty()) {
    scene = with_look(std::move(scene), load_scene(look, overrides));
  } else if (!look.empty() || !overrides.empty()) {
    LoadedScene other = look.empty() ? folder.load(overrides) : load_scene(look, overrides, cells_of(scene));
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

}  // namespace

bool is_motion_file(const std::string& file) {
  const OutputFormat* format = find_format(file);
  return format != nullptr && format->of_steps();
}

SceneToRun open_motion(const std::string& file, const std::vector<std::string>& overrides, const std::string& look) {
  const auto motion = std::make_shared<OpenMotion>(file);
  return {scene_to_draw(file, motion->reader.header(), motion->folder, overrides, look),
          std::shared_ptr<MotionReader>(motion, &motion->reader)};
}

namespace {

/// A temporary motion file, kept while it is read.
struct ImportedFile {
  TemporaryFolder folder{"drape-import"};
  SceneToRun opened = {};
};

/// Imports a motion into a temporary motion file.
/// @param name name of that file
std::shared_ptr<ImportedFile> import_for_now(const ImportOptions& options, const std::string& name,
                                             const std::vector<std::string>& overrides, const std::string& look) {
  auto imported = std::make_shared<ImportedFile>();
  const std::filesystem::path motion = imported->folder.path() / (name + ".drape");
  try {
    run_watched(
        true, [&](const std::stop_token& stop, Progress& progress) { import_motion(options, motion, stop, progress); });
  } catch (const Interrupted&) {
    throw UsageError(shown(options.cloths.front()) + ": interrupted while it was read");
  }
  imported->opened = open_motion(motion.string(), overrides, look);
  return imported;
}

SceneToRun with_scene(const std::shared_ptr<ImportedFile>& imported, LoadedScene scene) {
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

SceneToRun open_scene(const std::string& file, const std::vector<std::string>& overrides, const std::string& look) {
  if (file.ends_with(".drape.partial")) {
    throw UsageError(fmt::format("{0} is not complete: drape simulate --resume {0} continues it", file));
  }
  if (is_motion_file(file)) return open_motion(file, overrides, look);
  if (is_importable(file)) return open_import(file, overrides, look);
  if (const auto of_motion = load_scene_of_motion(file, overrides)) {
    if (!look.empty())
      throw UsageError(fmt::format("{}: it says itself how its motion looks: omit --scene", shown(file)));
    return open_scene_of_motion(file, *of_motion);
  }
  return {load_scene(file, overrides), nullptr};
}

std::vector<SceneToRun> open_scenes(const std::vector<std::string>& files, const std::vector<std::string>& overrides) {
  std::vector<SceneToRun> scenes;
  SceneProblems problems;
  for (const std::string& file : files) {
    try {
      scenes.push_back(open_scene(file, overrides));
    } catch (const UsageError& error) {
      problems.add(file, error.what());
    }
  }
  problems.throw_if_any(files);
  return scenes;
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
    throw UsageError(
        fmt::format("{} needs a simulation, and {} is only read: use it with drape simulate", option, file));
  }
  if (options.motion) throw UsageError(fmt::format("-o {}: {} is already a motion file", options.motion->path, file));
}

}  // namespace drape
