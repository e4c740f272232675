#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "cli/command_line.hpp"
#include "cli/inputs.hpp"
#include "cli/options.hpp"
#include "cli/scene_run.hpp"
#include "cli/terminal.hpp"
#include "core/console.hpp"
#include "core/text.hpp"
#include "drape/render/image.hpp"
#include "drape/scene/scene.hpp"
#include "motion/import/import_motion.hpp"
#include "output/registry.hpp"
#include "render/gl/context.hpp"
#include "run/outputs.hpp"
#include "run/records.hpp"
#include "run/run_scene.hpp"

namespace drape {
namespace {

/// Validates all scenes before the first one runs: drawing is possible and files are writable.
/// @throws Error with the problems of all scenes
void look_ahead(const std::vector<LoadedScene>& scenes, const std::vector<RunOptions>& options) {
  require_distinct_files(scenes, options);
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
    const LoadedScene& scene = scenes[i];
    attempt([&] { require_outputs(scene, options[i]); });
    if (!needs_drawing(options[i])) continue;
    attempt([&] { require_texture(scene, largest_texture); });
    if (Annotations::wanted(scene)) attempt([&] { const Annotations fonts_are_there(scene); });
  }
  if (worst) throw Error(*worst, problems);
}

/// @throws UsageError if an output needs drawing
void require_no_drawing(const std::vector<std::string>& outputs) {
  for (const std::string& path : outputs) {
    const OutputFormat* format = find_format(path);
    if (format == nullptr || !format->drawn()) continue;
    throw UsageError(fmt::format("drape simulate draws nothing, but -o {} has to be drawn: use drape render", path));
  }
}

ExitCode run(const LoadedScene& scene, const RunOptions& options, const RunArguments& arguments,
             const CommonOptions& common) {
  SceneRun run(scene, options, arguments, common);
  run.announce();
  run.begin();
  return run.end();
}

/// @throws UsageError for options of outputs without any output
void require_something_to_make(const RunArguments& arguments) {
  if (!arguments.outputs.empty()) return;
  const bool frames = !arguments.frames.empty() || arguments.times.any() || !arguments.every.empty();
  if (arguments.overrides.empty() && !arguments.steps && !frames) return;
  throw UsageError(
      fmt::format("--resume {} continues the run as it began; --set, --steps, --frames and --every apply to outputs of "
                  "the whole motion, and there is no -o",
                  arguments.resume));
}

/// Checks that no record is requested which a motion of another program does not hold.
/// @throws UsageError
void require_known_records(const std::string& file, const MotionHeader& header, const RecordPaths& records) {
  for (const auto& [option, path, known] :
       {std::tuple{"--stats", records.stats, !header.imported}, std::tuple{"--trace", records.trace, !header.imported},
        std::tuple{"--energies", records.energies, header.energies}}) {
    if (path.empty() || known) continue;
    throw UsageError(fmt::format("{} {}: another program made {} without these values", option, path, file));
  }
}

/// Makes the requested outputs of a complete motion.
ExitCode make_of_motion(const std::string& file, const RunArguments& arguments, const CommonOptions& common) {
  const SceneToRun found = open_scene(file, arguments.overrides, arguments.look);
  RunOptions options = run_options(arguments, found.scene, common.verbose);
  require_distinct_files({found.scene}, {options});
  const RecordPaths records = std::exchange(options.records, {});
  require_known_records(file, found.recorded->header(), records);
  limit_to_motion(file, found.recorded->last_step(), options);
  choose_frames(arguments.times, found.scene, options);
  options.recorded = found.recorded;
  if (!arguments.outputs.empty()) look_ahead({found.scene}, {options});
  const std::vector<std::string> written = write_records(*found.recorded, found.scene, records);
  for (const std::string& record : written) {
    if (!common.quiet) print_text(stdout, record + "\n");
  }
  if (!arguments.outputs.empty()) return run(found.scene, options, arguments, common);
  if (written.empty()) spdlog::info("{} is complete", file);
  return ExitCode::ok;
}

/// Checks the files of a resumed run together with those of the outputs made afterwards.
/// @param drawn scene of these outputs, with the motion among its inputs
/// @throws UsageError as for a run that does both at once
void require_distinct_resumed_files(const std::string& motion, LoadedScene drawn, const RunOptions& run,
                                    RunOptions later) {
  std::erase(drawn.source.inputs, motion);
  later.motion = run.motion;
  later.records = run.records;
  require_distinct_files({std::move(drawn)}, {std::move(later)});
}

/// Resumes a run, then makes the requested outputs of the whole motion.
ExitCode resume_run(const RunArguments& arguments, const CommonOptions& common) {
  if (!arguments.scenes.empty()) {
    throw UsageError(
        fmt::format("--resume {} continues the run of its own scene, and takes no SCENE", arguments.resume));
  }
  require_something_to_make(arguments);
  const std::string file = motion_to_resume(arguments.resume);
  auto found = find_resumable_run(file, arguments.overrides, arguments.look);
  if (!found) return make_of_motion(file, arguments, common);

  RunArguments rest = arguments, afterwards = arguments;
  rest.outputs.clear();
  rest.overrides.clear();
  rest.steps.reset();
  rest.frames = rest.every = rest.max_size = rest.keep = rest.start = rest.sheet = {};
  rest.poster = false;
  afterwards.records = {};
  RunOptions later = run_options(afterwards, found->drawn, common.verbose);
  limit_to_motion(file, *found->options.steps, later);
  choose_frames(arguments.times, found->drawn, later);
  look_ahead({found->drawn}, {later});

  RunOptions options = found->options;
  const RunOptions own = run_options(rest, *found->scene, common.verbose);
  options.records = own.records;
  options.threads = own.threads;
  options.time_effects = own.time_effects;
  options.motion->checkpoint_seconds = arguments.checkpoint_seconds;
  require_distinct_resumed_files(file, found->drawn, options, later);
  require_outputs(*found->scene, options);
  const ExitCode code = run(*found->scene, options, arguments, common);
  if (code != ExitCode::ok || arguments.outputs.empty()) return code;
  afterwards.step_by_step = false;
  found.reset();  // close its files
  return make_of_motion(file, afterwards, common);
}

std::vector<SceneToRun> load_all(const RunArguments& arguments) {
  std::vector<SceneToRun> all;
  SceneProblems problems;
  for (const std::string& file : arguments.scenes) {
    if ((is_motion_file(file) || is_importable(file)) && !arguments.drawing) {
      throw UsageError(fmt::format("{0} is already a motion: use drape render to draw it{1}", file,
                                   is_motion_file(file) ? ", or --resume " + file + " for its records" : ""));
    }
    try {
      all.push_back(open_scene(file, arguments.overrides, arguments.look));
      if (all.back().recorded && !arguments.drawing) {
        problems.add(file,
                     fmt::format("{}: its motion is read, so there is nothing to simulate: use drape render", file));
      }
    } catch (const UsageError& error) {
      problems.add(file, error.what());
    }
  }
  problems.throw_if_any(arguments.scenes);
  return all;
}

/// Runs the scenes in sequence. While a film is made, the next one is as well: a single film leaves processors idle
/// during its simulation, which precedes the drawing, and while its file is completed. Messages keep the order of the
/// scenes. A failed scene does not stop later ones.
/// @returns the highest of their codes
ExitCode run_each(const std::vector<LoadedScene>& scenes, const std::vector<RunOptions>& options,
                  const RunArguments& arguments, const CommonOptions& common) {
  ExitCode worst = ExitCode::ok;
  std::unique_ptr<SceneRun> run, next;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    run = std::move(next);
    if (!run && i > 0 && interruption().stop_requested()) {
      if (worst != ExitCode::interrupted) spdlog::error("interrupted before {}", shown(scenes[i].source.file));
      return ExitCode::interrupted;
    }
    worst = std::max(worst, reported([&] {
                       if (!run) run = std::make_unique<SceneRun>(scenes[i], options[i], arguments, common);
                       run->announce();
                       run->begin();
                       if (!arguments.step_by_step && i + 1 < scenes.size() && needs_drawing(options[i]) &&
                           needs_drawing(options[i + 1]) && !interruption().stop_requested()) {
                         next = std::make_unique<SceneRun>(scenes[i + 1], options[i + 1], arguments, common);
                         next->begin();
                       }
                       return run->end();
                     }));
  }
  return worst;
}

/// Runs all scenes of the command line.
ExitCode run_all(const RunArguments& arguments, const CommonOptions& common) {
  interruption();  // from here on, a signal stops work cleanly
  if (arguments.scenes.empty() && arguments.resume.empty()) throw UsageError("SCENE is required; see drape --help");
  if (!arguments.drawing) require_no_drawing(arguments.outputs);
  if (!arguments.resume.empty()) return resume_run(arguments, common);
  std::vector<LoadedScene> scenes;
  std::vector<RunOptions> options;
  for (SceneToRun& found : load_all(arguments)) {
    options.push_back(run_options(arguments, found.scene, common.verbose));
    if (found.recorded) {
      limit_to_motion(shown(found.scene.source.file), found.recorded->last_step(), options.back());
    }
    choose_frames(arguments.times, found.scene, options.back());
    options.back().recorded = found.recorded;
    scenes.push_back(std::move(found.scene));
  }
  look_ahead(scenes, options);
  return run_each(scenes, options, arguments, common);
}

}  // namespace

void add_run_commands(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<RunArguments>();

  CLI::App* render = app.add_subcommand("render", "Simulate scenes and render films, or render recorded motions");
  add_outputs(*render, *arguments, "repeatable; default out/{scene}.gif", true);
  render->add_option("--sheet", arguments->sheet, sheet_help);
  add_backend_option(*render, arguments->backend);
  add_file_limit(*render, arguments->max_size, arguments->keep);
  render->add_flag("--poster", arguments->poster,
                   "Also write FILM.poster.png beside each film: its most telling frame");
  render
      ->add_option(
          "--start", arguments->start,
          "Frame that a GIF, WebP or APNG begins with, which a page shows until it plays: first (the default) or "
          "poster")
      ->check(CLI::IsMember({"first", "poster"}));
  render->add_flag("--open", arguments->open, "Show the first output when it is complete, with xdg-open");
  add_shared_options(*render, *arguments, "Scene files (TOML), or motions: .drape, or what drape import reads");
  render->add_option("--scene", arguments->look, "Render motions with the camera, look and film of this scene");
  complete_command(
      *render, command,
      [arguments, &common] {
        if (arguments->outputs.empty())
          arguments->outputs = {arguments->sheet.empty() ? "out/{scene}.gif" : "out/{scene}.png"};
        return run_all(*arguments, common);
      },
      "render scene.toml                                    # out/scene.gif\n"
      "render scene.toml --quality draft --open\n"
      "render scene.toml -o film.mp4 -o frames/{frame:04}.png\n"
      "render scene.toml --set video.fps=50 --frames 100..120\n"
      "render scene.toml -o film.webp --max-size 2MB --poster\n"
      "render motion.drape --set video.speed=0.1 -o slow.mp4");

  CLI::App* simulate = app.add_subcommand("simulate", "Simulate scenes without drawing them");
  add_outputs(*simulate, *arguments, "repeatable", false);
  add_shared_options(*simulate, *arguments, "Scene files (TOML)");
  complete_command(
      *simulate, command,
      [arguments, &common] {
        arguments->drawing = false;
        return run_all(*arguments, common);
      },
      "simulate scene.toml --energies energies.csv --stats stats.json\n"
      "simulate scene.toml -o meshes/{frame:04}.obj\n"
      "simulate scene.toml -o motion.npz --every 1\n"
      "simulate scene.toml -o motion.drape\n"
      "simulate --resume motion.drape");
}

}  // namespace drape
