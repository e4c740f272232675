#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "cli/byte_count.hpp"
#include "cli/command_line.hpp"
#include "cli/frame_list.hpp"
#include "cli/grid_option.hpp"
#include "cli/interruption.hpp"
#include "cli/number_option.hpp"
#include "cli/output_clashes.hpp"
#include "cli/scene_files.hpp"
#include "cli/step_by_step.hpp"
#include "cli/summary.hpp"
#include "cli/watched.hpp"
#include "core/console.hpp"
#include "output/path_template.hpp"
#include "output/registry.hpp"
#include "render/gl/inspect.hpp"
#include "render/texture_image.hpp"
#include "run/annotations.hpp"
#include "run/outputs.hpp"
#include "run/run_scene.hpp"
#include "scene/scene.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/simulation.hpp"

namespace drape {
namespace {

/// What render and simulate share.
struct RunArguments {
  std::vector<std::string> scenes;
  std::vector<std::string> overrides;
  std::vector<std::string> outputs;
  std::string frames, max_size, sheet;
  std::optional<std::int64_t> steps, every;
  bool poster = false;
  RecordPaths records;
  GlBackend backend = GlBackend::automatic;
  bool step_by_step = false;
  bool drawing = true;  ///< render; simulate draws nothing
};

RunOptions run_options(const RunArguments& arguments, const Scene& scene, bool verbose) {
  const auto expanded = [&](const std::string& text) {
    const PathTemplate path(text);
    if (path.has_frame())
      throw UsageError(fmt::format("'{}' is one file for the whole run: it cannot hold {{frame}}", text));
    return path.path(scene.name, 0, 1);
  };
  RunOptions options;
  options.outputs = arguments.outputs;
  options.records = {.stats = expanded(arguments.records.stats),
                     .energies = expanded(arguments.records.energies),
                     .positions = expanded(arguments.records.positions),
                     .trace = expanded(arguments.records.trace)};
  options.steps = arguments.steps;
  if (!arguments.frames.empty()) options.frames = parse_frames(arguments.frames);
  options.every = arguments.every;
  if (!arguments.max_size.empty()) options.largest_file = parse_byte_count("--max-size", arguments.max_size);
  options.poster = arguments.poster;
  options.sheet = parse_sheet(arguments.sheet, options.outputs);
  options.backend = arguments.backend;
  options.time_effects = verbose || !arguments.records.stats.empty();
  return options;
}

/// Looks at all that is known before the first scene runs: whether every scene can be drawn and its files written.
/// @throws Error with the problems of all scenes
void look_ahead(const std::vector<Scene>& scenes, const std::vector<RunOptions>& options) {
  require_files_of_their_own(scenes, options);
  const bool drawn = std::any_of(options.begin(), options.end(), needs_drawing);
  const int largest_texture = drawn ? inspect_backend(options.front().backend).max_texture_size : 0;
  ExitCode worst = ExitCode::ok;
  std::string problems;
  const auto attempt = [&](const auto& work) {
    try {
      work();
    } catch (const Error& error) {
      problems += (problems.empty() ? "" : "\n") + std::string(error.what());
      worst = std::max(worst, error.code());
    }
  };
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene& scene = scenes[i];
    attempt([&] { require_outputs(scene, options[i]); });
    if (!needs_drawing(options[i])) continue;
    attempt([&] { require_texture(scene, largest_texture); });
    if (Annotations::wanted(scene)) attempt([&] { const Annotations fonts_are_there(scene); });
  }
  if (worst != ExitCode::ok) throw Error(worst, problems);
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

ExitCode run(const Scene& scene, RunOptions options, bool step_by_step, const CommonOptions& common) {
  spdlog::info(describe(scene, options));
  if (scene.simulation.integrator.allow_unstable) {
    if (const auto problem = stability_problem(scene.simulation, make_system(scene.simulation))) {
      spdlog::warn("{}: {}", scene.file.string(), *problem);
    }
  }
  StepByStep pause(interruption());
  if (step_by_step) options.observer = &pause;
  RunResult result;
  run_watched(common.quiet || step_by_step, [&](const std::stop_token& stop, Progress& progress) {
    result = run_scene(scene, options, stop, progress);
  });
  if (!result.renderer.empty()) spdlog::debug("drawn by {}", result.renderer);
  if (common.verbose) spdlog::debug(effect_shares(result.statistics));
  if (!common.quiet && result.statistics.steps() > 0) print_text(stderr, summarize(result) + "\n");
  for (const std::string& doubt : doubts(result)) spdlog::warn("{}: {}", scene.file.string(), doubt);
  return conclude(scene, result);
}

/// Runs one scene after the other. One that fails does not keep the next from being run.
/// @returns the worst of their codes, which is the largest
ExitCode run_all(const RunArguments& arguments, const CommonOptions& common) {
  interruption();  // from here on, a signal ends what there is in good order
  if (!arguments.drawing) require_no_drawing(arguments.outputs);
  require_a_film(arguments);
  const std::vector<Scene> scenes = load_scenes(arguments.scenes, arguments.overrides);
  std::vector<RunOptions> options;
  for (const Scene& scene : scenes) options.push_back(run_options(arguments, scene, common.verbose));
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

void add_shared_options(CLI::App& command, RunArguments& arguments) {
  command.add_option("SCENE", arguments.scenes, "Scene files (TOML)")->required();
  const auto one_each = [](CLI::Option* option) { option->allow_extra_args(false); };
  one_each(
      command.add_option("--set", arguments.overrides, "key.path=value: replaces a value of the scene; repeatable"));
  command.add_option("--steps", arguments.steps, "Simulate this many steps instead of the scene's duration")
      ->check(whole_number_in({0, 1e9}));
  command.add_option("--frames", arguments.frames, "A..B: only these frames of the film");
  command
      .add_option("--every", arguments.every, "N: a frame after every N steps, instead of as [video] fps and speed say")
      ->check(whole_number_in({1, 1e9}));
  command.add_option("--stats", arguments.records.stats, "Write the run's figures to a JSON file");
  command.add_option("--energies", arguments.records.energies, "Write the energies of every step to a CSV file");
  command.add_option("--positions", arguments.records.positions, "Write the last positions to a CSV file");
  command.add_option("--trace", arguments.records.trace,
                     "Write iterations, residual and time of every step to a CSV file");
  command.add_flag("--step-by-step", arguments.step_by_step, "Pause after each step and print its energies");
}

/// @param drawn whether what must be drawn may be among them
void add_outputs(CLI::App& command, RunArguments& arguments, const std::string& usage, bool drawn) {
  command
      .add_option("-o,--output", arguments.outputs,
                  fmt::format("Where to, and by the extension in which form; {}.\nWhat ends early, by Ctrl-C or a "
                              "diverging motion, becomes NAME.partial.EXT.\n{}",
                              usage, output_help(drawn)))
      ->allow_extra_args(false);
}

}  // namespace

void add_run_commands(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<RunArguments>();

  CLI::App* render = app.add_subcommand("render", "Simulate scenes and draw them into films");
  add_outputs(*render, *arguments, "repeatable; default out/{scene}.gif", true);
  render->add_option("--sheet", arguments->sheet, sheet_help);
  add_backend_option(*render, arguments->backend);
  render->add_option("--max-size", arguments->max_size,
                     "5MB: make a film's pictures smaller until it has no more bytes; also kB, GB, kiB, MiB, GiB");
  render->add_flag("--poster", arguments->poster, "Put FILM.poster.png beside each film: the frame that shows most");
  add_shared_options(*render, *arguments);
  render->callback([arguments, &common, &command] {
    if (arguments->outputs.empty())
      arguments->outputs = {arguments->sheet.empty() ? "out/{scene}.gif" : "out/{scene}.png"};
    command = [arguments, &common] { return run_all(*arguments, common); };
  });

  CLI::App* simulate = app.add_subcommand("simulate", "Simulate scenes without drawing them");
  add_outputs(*simulate, *arguments, "repeatable", false);
  add_shared_options(*simulate, *arguments);
  simulate->callback([arguments, &common, &command] {
    arguments->drawing = false;
    command = [arguments, &common] { return run_all(*arguments, common); };
  });
}

}  // namespace drape
