#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "cli/command_line.hpp"
#include "cli/grid_option.hpp"
#include "cli/interruption.hpp"
#include "cli/motion_runs.hpp"
#include "cli/output_clashes.hpp"
#include "cli/run_arguments.hpp"
#include "cli/step_by_step.hpp"
#include "cli/summary.hpp"
#include "cli/watched.hpp"
#include "core/console.hpp"
#include "output/registry.hpp"
#include "render/gl/inspect.hpp"
#include "render/texture_image.hpp"
#include "run/annotations.hpp"
#include "run/motion_frames.hpp"
#include "run/motion_space.hpp"
#include "run/outputs.hpp"
#include "run/run_scene.hpp"
#include "scene/scene.hpp"
#include "sim/make_system.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/simulation.hpp"

namespace drape {
namespace {

/// Looks at all that is known before the first scene runs: whether every scene can be drawn and its files written.
/// @throws Error with the problems of all scenes
void look_ahead(const std::vector<Scene>& scenes, const std::vector<RunOptions>& options) {
  require_files_of_their_own(scenes, options);
  const bool drawn = std::any_of(options.begin(), options.end(), needs_drawing);
  const int largest_texture = drawn ? inspect_backend(options.front().backend).max_texture_size : 0;
  std::optional<ErrorKind> worst;
  std::string problems;
  const auto attempt = [&](const auto& work) {
    try {
      work();
    } catch (const Error& error) {
      problems += (problems.empty() ? "" : "\n") + std::string(error.what());
      worst = std::max(worst.value_or(error.kind()), error.kind());
    }
  };
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene& scene = scenes[i];
    attempt([&] { require_outputs(scene, options[i]); });
    if (!needs_drawing(options[i])) continue;
    attempt([&] { require_texture(scene, largest_texture); });
    if (Annotations::wanted(scene)) attempt([&] { const Annotations fonts_are_there(scene); });
  }
  if (worst) throw Error(*worst, problems);
}

/// @throws UsageError if an output must be drawn where nothing is
void require_no_drawing(const std::vector<std::string>& outputs) {
  for (const std::string& path : outputs) {
    const OutputFormat* format = find_format(path);
    if (format == nullptr || !format->drawn()) continue;
    throw UsageError(fmt::format("drape simulate draws nothing, and -o {} must be drawn: use drape render", path));
  }
}

/// @throws UsageError if what is asked of a film is asked where there is none
void require_a_film(const RunArguments& arguments) {
  if (arguments.max_size.empty() && !arguments.poster) return;
  const auto is_film = [](const std::string& path) {
    const OutputFormat* format = find_format(path);
    return format != nullptr && format->drawn() && !format->file_per_frame();
  };
  if (std::ranges::any_of(arguments.outputs, is_film)) return;
  throw UsageError(fmt::format("{} is for films, and no -o is one, such as .gif, .webp or .mp4",
                               arguments.poster ? "--poster" : "--max-size"));
}

/// Says how a run ended, and returns its exit code.
ExitCode conclude(const Scene& scene, const RunResult& result) {
  for (const std::string& problem : result.problems) spdlog::error(problem);
  const ExitCode outputs = result.problems.empty() ? ExitCode::ok : ExitCode::output;
  switch (result.outcome) {
    case Outcome::completed:
      return outputs;
    case Outcome::interrupted:
      spdlog::error("interrupted {}", describe_end(result));
      return ExitCode::interrupted;
    case Outcome::diverged:
      spdlog::error("{}: {}", scene.file.string(), result.divergence);
      spdlog::error("ended {}", describe_end(result));
      return std::max(outputs, ExitCode::diverged);
  }
  return outputs;
}

/// Says where a film shows what the motion's file does not hold.
void warn_of_gaps(const Scene& scene, const RunOptions& options) {
  const int between = frames_in_gaps(*options.recorded, film_extent(scene, options));
  if (between == 0) return;
  spdlog::warn("{}: {} frames lie between states that are more than a step apart, and are interpolated between them",
               scene.file.string(), between);
}

ExitCode run(const Scene& scene, RunOptions options, bool step_by_step, const CommonOptions& common) {
  spdlog::info(describe(scene, options));
  if (scene.simulation.integrator.allow_unstable) {
    if (const auto problem = stability_problem(scene.simulation, make_system(scene.simulation))) {
      spdlog::warn("{}: {}", scene.file.string(), *problem);
    }
  }
  if (options.motion) {
    const MotionSpace space = motion_space(scene, options);
    if (space.most > space.free) spdlog::warn(space.text(options.motion->path));
  }
  if (options.recorded) warn_of_gaps(scene, options);
  StepByStep pause(interruption());
  if (step_by_step) options.observer = &pause;
  RunResult result;
  run_watched(common.quiet || step_by_step, [&](const std::stop_token& stop, Progress& progress) {
    result = run_scene(scene, options, stop, progress);
  });
  if (!result.renderer.empty()) spdlog::debug("drawn by {}", result.renderer);
  if (common.verbose) spdlog::debug(effect_shares(result.statistics));
  if (!common.quiet && (result.statistics.steps() > 0 || options.recorded))
    print_text(stderr, summarize(result) + "\n");
  for (const std::string& doubt : doubts(result)) spdlog::warn("{}: {}", scene.file.string(), doubt);
  return conclude(scene, result);
}

/// Goes on with a run that ended early.
ExitCode go_on(const RunArguments& arguments, const CommonOptions& common) {
  if (!arguments.scenes.empty() || !arguments.overrides.empty() || !arguments.outputs.empty() || arguments.steps ||
      !arguments.frames.empty() || !arguments.every.empty()) {
    throw UsageError(
        fmt::format("--resume {0} goes on as the run began, and takes no SCENE, -o, --set, --steps, --frames or "
                    "--every; once it is "
                    "complete, drape render {0} makes films and other forms of it",
                    arguments.resume));
  }
  const auto found = find_run_to_go_on(arguments.resume);
  if (!found) {
    spdlog::info("{} is complete", arguments.resume);
    return ExitCode::ok;
  }
  RunOptions options = found->options;
  const RunOptions own = run_options(arguments, *found->scene, common.verbose);
  options.records = own.records;
  options.time_effects = own.time_effects;
  options.motion->checkpoint_seconds = arguments.checkpoint_seconds;
  require_outputs(*found->scene, options);
  return run(*found->scene, options, arguments.step_by_step, common);
}

std::vector<SceneToRun> load_all(const RunArguments& arguments) {
  std::vector<SceneToRun> all;
  std::string problems;
  for (const std::string& file : arguments.scenes) {
    const bool motion = is_motion_file(file);
    if (file.ends_with(".drape.partial")) {
      throw UsageError(fmt::format("{0} is not complete: drape simulate --resume {0} goes on with it", file));
    }
    if (motion && !arguments.drawing) {
      throw UsageError(fmt::format("{} is a motion already: drape render draws it, drape simulate computes one", file));
    }
    try {
      all.push_back(motion ? open_motion(file, arguments.overrides, arguments.look)
                           : SceneToRun{load_scene(file, arguments.overrides), nullptr});
    } catch (const UsageError& error) {
      problems += (problems.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  if (!problems.empty()) throw UsageError(problems);
  return all;
}

/// Runs one scene after the other. One that fails does not keep the next from being run.
/// @returns the worst of their codes, which is the largest
ExitCode run_all(const RunArguments& arguments, const CommonOptions& common) {
  interruption();  // from here on, a signal ends what there is in good order
  if (!arguments.resume.empty()) return go_on(arguments, common);
  if (arguments.scenes.empty()) throw UsageError("SCENE is required; see drape --help");
  if (!arguments.drawing) require_no_drawing(arguments.outputs);
  require_a_film(arguments);
  std::vector<Scene> scenes;
  std::vector<RunOptions> options;
  for (SceneToRun& found : load_all(arguments)) {
    options.push_back(run_options(arguments, found.scene, common.verbose));
    if (found.recorded) limit_to_motion(*found.recorded, options.back());
    options.back().recorded = found.recorded;
    scenes.push_back(std::move(found.scene));
  }
  look_ahead(scenes, options);
  ExitCode worst = ExitCode::ok;
  for (std::size_t i = 0; i < scenes.size() && worst != ExitCode::interrupted; ++i) {
    if (interrupted() && i > 0) {
      spdlog::error("interrupted before {}", scenes[i].file.string());
      return ExitCode::interrupted;
    }
    worst = std::max(worst, reported([&] { return run(scenes[i], options[i], arguments.step_by_step, common); }));
  }
  return worst;
}

}  // namespace

void add_run_commands(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<RunArguments>();

  CLI::App* render = app.add_subcommand("render", "Simulate scenes and draw them into films, or draw motions");
  add_outputs(*render, *arguments, "repeatable; default out/{scene}.gif", true);
  render->add_option("--sheet", arguments->sheet, sheet_help);
  add_backend_option(*render, arguments->backend);
  render->add_option("--max-size", arguments->max_size,
                     "5MB: make a film's pictures smaller until it has no more bytes; also kB, GB, kiB, MiB, GiB");
  render->add_flag("--poster", arguments->poster, "Put FILM.poster.png beside each film: the frame that shows most");
  add_shared_options(*render, *arguments, "Scene files (TOML), or motions (.drape) that drape simulate has computed");
  render->add_option("--scene", arguments->look, "Draws motions with the camera, look and film of this scene");
  render->callback([arguments, &common, &command] {
    if (arguments->outputs.empty())
      arguments->outputs = {arguments->sheet.empty() ? "out/{scene}.gif" : "out/{scene}.png"};
    command = [arguments, &common] { return run_all(*arguments, common); };
  });

  CLI::App* simulate = app.add_subcommand("simulate", "Simulate scenes without drawing them");
  add_outputs(*simulate, *arguments, "repeatable", false);
  add_shared_options(*simulate, *arguments, "Scene files (TOML)");
  simulate->add_option("--resume", arguments->resume,
                       "MOTION.drape: goes on with a run that was interrupted or killed, to the same bits");
  simulate->callback([arguments, &common, &command] {
    arguments->drawing = false;
    command = [arguments, &common] { return run_all(*arguments, common); };
  });
}

}  // namespace drape
