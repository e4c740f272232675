#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "check/check_scene.hpp"
#include "check/golden_folder.hpp"
#include "cli/background_work.hpp"
#include "cli/command_line.hpp"
#include "cli/frame_list.hpp"
#include "cli/motion_runs.hpp"
#include "core/console.hpp"
#include "core/text.hpp"

namespace drape {
namespace {

struct BlessArguments {
  std::vector<std::string> scenes;
  std::string frames;
  GlBackend backend = GlBackend::automatic;
};

ExitCode bless(const BlessArguments& arguments, const CommonOptions& common) {
  const std::vector<int> frames = parse_frame_list(arguments.frames);
  const std::vector<SceneToRun> scenes = open_scenes(arguments.scenes, {});
  for (const auto& [scene, recorded] : scenes) has_golden(golden_folder(scene.file));  // check all before blessing any
  for (const SceneToRun& opened : scenes) {
    const Scene& scene = opened.scene;
    CheckSettings settings = scene.check;
    if (!frames.empty()) settings.frames = frames;
    std::optional<Blessing> blessing;
    run_watched(common.quiet, [&](const std::stop_token& stop, Progress& progress) {
      std::optional<PlayedMotion> played;
      if (opened.recorded) played.emplace(*opened.recorded);
      blessing = bless_scene(scene, settings, arguments.backend, stop, progress, played ? &*played : nullptr);
    });
    if (!blessing) {
      spdlog::error("interrupted: {} is unchanged", shown(golden_folder(scene.file)));
      return ExitCode::interrupted;
    }
    if (!common.quiet) {
      print_text(stdout, fmt::format("{}: recorded {} frame{}, {} kB\n", shown(blessing->folder), blessing->frames,
                                     blessing->frames == 1 ? "" : "s", (blessing->size + 500) / 1000));
    }
  }
  return ExitCode::ok;
}

}  // namespace

void add_bless_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<BlessArguments>();
  CLI::App* sub = app.add_subcommand("bless", "Record the golden frames and motion that drape check compares to");
  sub->add_option("SCENE", arguments->scenes, "Scene files (TOML), or motions: .drape, or what drape import reads")
      ->required();
  sub->add_option("--frames", arguments->frames, "Frames of the film to compare: A,B,C; see [check] in the scene");
  add_backend_option(*sub, arguments->backend);
  sub->callback(
      [arguments, &common, &command] { command = [arguments, &common] { return bless(*arguments, common); }; });
}

}  // namespace drape
