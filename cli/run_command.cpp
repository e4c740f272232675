#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <charconv>

#include "cli/command_line.hpp"
#include "cli/interruption.hpp"
#include "cli/progress_display.hpp"
#include "cli/scene_files.hpp"
#include "cli/summary.hpp"
#include "render/encode/path_template.hpp"
#include "run/run_scene.hpp"
#include "scene/scene.hpp"
#include "sim/simulation.hpp"
#include "sim/schemes/registry.hpp"

namespace drape {
namespace {

/// What render and simulate share.
struct RunArguments {
  std::vector<std::string> scenes;
  std::vector<std::string> overrides;
  std::vector<std::string> outputs;
  std::string frames;
  std::optional<std::int64_t> steps;
  RecordPaths records;
  GlBackend backend = GlBackend::automatic;
  bool step_by_step = false;
};

FrameRange parse_frames(const std::string& text) {
  FrameRange range;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, range.first);
  const bool two = first.ec == std::errc() && std::string_view(first.ptr, end).starts_with("..");
  const auto last = two ? std::from_chars(first.ptr + 2, end, range.last) : first;
  if (!two || last.ec != std::errc() || last.ptr != end || range.first < 0 || range.last < range.first) {
    throw UsageError(fmt::format("--frames takes A..B, two frame numbers with 0 ≤ A ≤ B, found '{}'", text));
  }
  return range;
}

/// With several scenes, a file that is not named after its scene would be written over by the next.
void check_names(const RunArguments& arguments) {
  if (arguments.scenes.size() < 2) return;
  std::vector<std::string> names = arguments.outputs;
  const RecordPaths& r = arguments.records;
  names.insert(names.end(), {r.stats, r.energies, r.positions, r.trace});
  for (const std::string& name : names) {
    if (!name.empty() && name.find("{scene}") == std::string::npos) {
      throw UsageError(fmt::format("'{}' would be written by each of {} scenes: put {{scene}} into the name", name,
                                   arguments.scenes.size()));
    }
  }
}

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
  options.backend = arguments.backend;
  options.step_by_step = arguments.step_by_step;
  options.time_effects = verbose || !arguments.records.stats.empty();
  return options;
}

ExitCode run(const Scene& scene, const RunOptions& options, const CommonOptions& common) {
  spdlog::info(describe(scene, options));
  if (scene.simulation.integrator.allow_unstable) {
    if (const auto problem = stability_problem(scene.simulation, make_system(scene.simulation))) {
      spdlog::warn("{}: {}", scene.file.string(), *problem);
    }
  }
  Progress progress;
  ProgressDisplay display(progress, ProgressDisplay::fitting_style(common.quiet || options.step_by_step));
  const RunResult result = run_scene(scene, options, interruption(), progress, [&] { display.update(); });
  display.clear();
  if (!result.renderer.empty()) spdlog::debug("drawn by {}", result.renderer);
  if (common.verbose) spdlog::debug(effect_shares(result.statistics));
  if (!common.quiet) fmt::print(stderr, "{}\n", summarize(result));
  switch (result.outcome) {
    case Outcome::completed:
      return ExitCode::ok;
    case Outcome::interrupted:
      spdlog::error("interrupted; what was done so far is complete");
      return ExitCode::interrupted;
    case Outcome::diverged:
      spdlog::error("{}: {}", scene.file.string(), result.divergence);
      return ExitCode::diverged;
  }
  return ExitCode::ok;
}

ExitCode run_all(const RunArguments& arguments, const CommonOptions& common) {
  check_names(arguments);
  ExitCode worst = ExitCode::ok;
  for (const Scene& scene : load_scenes(arguments.scenes, arguments.overrides)) {
    const ExitCode code = run(scene, run_options(arguments, scene, common.verbose), common);
    if (code == ExitCode::interrupted) return code;
    if (worst == ExitCode::ok) worst = code;
  }
  return worst;
}

void add_shared_options(CLI::App& command, RunArguments& arguments) {
  command.add_option("SCENE", arguments.scenes, "Scene files (TOML)")->required();
  const auto one_each = [](CLI::Option* option) { option->allow_extra_args(false); };
  one_each(
      command.add_option("--set", arguments.overrides, "key.path=value: replaces a value of the scene; repeatable"));
  command.add_option("--steps", arguments.steps, "Simulate this many steps instead of the scene's duration")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--frames", arguments.frames, "A..B: only these frames of the film");
  command.add_option("--stats", arguments.records.stats, "Write the run's figures to a JSON file");
  command.add_option("--energies", arguments.records.energies, "Write the energies of every step to a CSV file");
  command.add_option("--positions", arguments.records.positions, "Write the last positions to a CSV file");
  command.add_option("--trace", arguments.records.trace,
                     "Write iterations, residual and time of every step to a CSV file");
  command.add_flag("--step-by-step", arguments.step_by_step, "Pause after each step and print its energies");
}

}  // namespace

void add_run_commands(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<RunArguments>();

  CLI::App* render = app.add_subcommand("render", "Simulate scenes and draw them into films");
  render
      ->add_option("-o,--output", arguments->outputs,
                   "A film (.gif .mp4 .webm .avi), frames ({frame:04}.png) or a still (.png); repeatable; "
                   "default out/{scene}.gif")
      ->allow_extra_args(false);
  add_backend_option(*render, arguments->backend);
  add_shared_options(*render, *arguments);
  render->callback([arguments, &common, &command] {
    if (arguments->outputs.empty()) arguments->outputs = {"out/{scene}.gif"};
    command = [arguments, &common] { return run_all(*arguments, common); };
  });

  CLI::App* simulate = app.add_subcommand("simulate", "Simulate scenes without drawing them");
  add_shared_options(*simulate, *arguments);
  simulate->callback(
      [arguments, &common, &command] { command = [arguments, &common] { return run_all(*arguments, common); }; });
}

}  // namespace drape
