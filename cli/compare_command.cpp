#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <memory>
#include <tuple>

#include "cli/command_line.hpp"
#include "cli/inputs.hpp"
#include "cli/options.hpp"
#include "cli/summary.hpp"
#include "cli/terminal.hpp"
#include "compare/compare_scenes.hpp"
#include "core/text.hpp"
#include "output/registry.hpp"
#include "render/gl/context.hpp"
#include "sweep/request.hpp"

namespace drape {
namespace {

struct CompareArguments {
  std::vector<std::string> scenes, overrides, varied;
  std::string grid, sheet, frames, every, max_size, keep;
  FilmTimes times;
  CompareOptions options;
};

/// Returns the number of values of the last key; 0 if too many for one row.
int last_of(const std::vector<std::string>& varied) {
  constexpr std::size_t widest = 6;
  const std::size_t count = parse_variation(varied.back()).values.size();
  return count > widest ? 0 : static_cast<int>(count);
}

/// Gives simulated scenes whose method was chosen the one that they share.
/// @param overrides of each scene
/// @param recorded  motion of each scene; null: it is simulated
void share_method(const std::vector<std::vector<std::string>>& overrides,
                  const std::vector<std::shared_ptr<MotionReader>>& recorded, std::vector<LoadedScene>& scenes) {
  std::vector<std::optional<MethodChoice>> choices;
  for (std::size_t i = 0; i < scenes.size(); ++i) choices.push_back(recorded[i] ? std::nullopt : scenes[i].choice);
  const std::vector<std::vector<std::string>> shared = shared_method_overrides(choices);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (shared[i].empty()) continue;
    std::vector<std::string> all = overrides[i];
    all.insert(all.end(), shared[i].begin(), shared[i].end());
    scenes[i] = open_scene(scenes[i].source.file.string(), all).scene;
  }
}

/// Loads the scenes in all variations.
/// @returns the scenes, and the motion of each if it is in a file
std::pair<std::vector<LoadedScene>, std::vector<std::shared_ptr<MotionReader>>> load_variations(
    const CompareArguments& arguments) {
  std::vector<LoadedScene> scenes;
  std::vector<std::shared_ptr<MotionReader>> recorded;
  std::vector<std::vector<std::string>> overrides;
  SceneProblems problems;
  const auto load = [&](const std::string& file, const std::vector<std::string>& some) {
    overrides.push_back(arguments.overrides);
    overrides.back().insert(overrides.back().end(), some.begin(), some.end());
    try {
      SceneToRun found = open_scene(file, overrides.back());
      if (found.recorded) require_steps(file, found.recorded->last_step(), arguments.options.steps);
      scenes.push_back(std::move(found.scene));
      recorded.push_back(std::move(found.recorded));
    } catch (const UsageError& error) {
      problems.add(file, as_varied(error.what(), some));
    }
  };
  std::vector<Variation> varied;
  for (const std::string& text : arguments.varied) varied.push_back(parse_variation(text));
  const std::vector<std::vector<std::string>> all = combinations(varied);
  for (const std::string& file : arguments.scenes) {
    for (const std::vector<std::string>& values : all) load(file, overrides_of(varied, values));
  }
  problems.throw_if_any(arguments.scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (recorded[i]) require_known_values(scenes[i].source.file.string(), recorded[i]->header(), scenes.front());
  }
  share_method(overrides, recorded, scenes);
  constexpr std::size_t most = 36;
  if (scenes.size() > most) {
    throw UsageError(fmt::format("{} motions cannot be shown side by side; the limit is {}", scenes.size(), most));
  }
  return {std::move(scenes), std::move(recorded)};
}

/// Sets the frame interval and the frames to draw. The first scene defines the time.
void choose_moments(const CompareArguments& arguments, std::vector<LoadedScene>& scenes, CompareOptions& options) {
  Scene& first = scenes.front();
  if (!arguments.every.empty()) {
    const double step = first.simulation.step;
    const RecordedSteps found = parse_every(arguments.every, step);
    if (!found.every)
      throw UsageError("--every frames is for motion files; give a number of steps or a time like 0.1s");
    first.video.speed = static_cast<double>(*found.every) * step * first.video.fps;
  }
  if (!arguments.frames.empty()) options.frames = parse_frames(arguments.frames);
  if (!arguments.times.any()) return;
  FilmExtent whole = compared_extent(scenes, options, 0);
  for (std::size_t i = 1; i < scenes.size(); ++i) {
    whole.frames.last = std::max(whole.frames.last, compared_extent(scenes, options, i).frames.last);
  }
  options.frames = frames_at(arguments.times, whole, "these motions");
}

ExitCode conclude(const CompareResult& result) {
  if (!result.missing.empty()) spdlog::warn(result.missing);
  for (const std::string& problem : result.problems) spdlog::error(problem);
  ExitCode code = result.problems.empty() ? ExitCode::ok : ExitCode::output;
  for (const ComparedMotion& motion : result.motions) {
    if (!motion.matched.empty()) spdlog::info("{}: {}", motion.label, motion.matched);
    if (motion.divergence.empty()) continue;
    spdlog::error("{}: {}", motion.label, motion.divergence);
    code = std::max(code, ExitCode::diverged);
  }
  if (!result.interrupted) return code;
  spdlog::error("interrupted after {} of {} frames", result.times.size(), result.frames_wanted);
  return ExitCode::interrupted;
}

ExitCode run_compare(const CompareArguments& arguments, const CommonOptions& common) {
  interruption();
  CompareOptions options = arguments.options;
  if (!arguments.grid.empty()) {
    const SheetGrid grid = parse_grid("--grid", arguments.grid);
    options.columns = grid.columns;
    options.rows = grid.rows;
  } else if (arguments.varied.size() > 1) {
    options.columns = last_of(arguments.varied);  // only the last key varies within a row
  }
  if (options.outputs.empty()) options.outputs = {arguments.sheet.empty() ? "out/compare.gif" : "out/compare.png"};
  options.sheet = parse_sheet(arguments.sheet, options.outputs);
  options.largest_file = parse_file_limit(arguments.max_size, arguments.keep, options.outputs);
  options.command = common.command;
  std::vector<LoadedScene> scenes;
  std::tie(scenes, options.recorded) = load_variations(arguments);
  choose_moments(arguments, scenes, options);
  std::vector<RunOptions> files(scenes.size());
  files.front().outputs = options.outputs;
  require_distinct_files(scenes, files);
  inspect_backend(options.backend);
  require_comparison(scenes, options);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (const auto& motion = options.recorded[i]) {
      warn_of_gaps(shown(scenes[i].source.file), *motion, compared_extent(scenes, options, i));
    }
  }

  CompareResult result;
  run_watched(common.quiet, [&](const std::stop_token& stop, Progress& progress) {
    result = compare_scenes(scenes, options, stop, progress);
  });
  if (!common.quiet) {
    for (const ComparedMotion& motion : result.motions) spdlog::info(motion.label);
    if (!result.outputs.empty()) print_wrapped(stderr, describe_files(result.outputs) + "\n");
  }
  return conclude(result);
}

}  // namespace

void add_compare_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<CompareArguments>();
  CompareOptions& options = arguments->options;
  CLI::App* sub = app.add_subcommand("compare", "Draw motions side by side");
  const auto one_each = [](CLI::Option* option) { option->allow_extra_args(false); };
  sub->add_option("SCENE", arguments->scenes, "Scene files (TOML), or motions: .drape, or what drape import reads")
      ->required();
  one_each(sub->add_option(
                  "-o,--output", options.outputs,
                  fmt::format(
                      "Output file; its extension selects the format (repeatable; default out/compare.gif).\n.html a "
                      "self-contained page: the motions in step, their figures and differences; its diagrams as files "
                      "are in NAME-diagrams\n{}",
                      output_help(FormatKinds::drawn)))
               ->check(on_one_line()));
  one_each(
      sub->add_option("--set", arguments->overrides, "Override a value of all scenes: key.path=value; repeatable"));
  one_each(sub->add_option(
      "--vary", arguments->varied,
      "Load each scene once with each of these values: key.path=value,value…, or a range FROM..TO/COUNT or "
      "FROM..TO/COUNTlog; repeatable"));
  sub->add_option("--grid", arguments->grid, "Layout of the panels: COLUMNSxROWS");
  CLI::Option* difference =
      sub->add_flag("--difference", options.difference,
                    "Colour each cloth by its distance from the first, vertex by vertex, over three decades");
  sub->add_option("--limit", options.limit,
                  "Distance of the last colour of --difference [m]; by default one that 95 % of the cloth stays below")
      ->check(number_in({.minimum = 0, .minimum_excluded = true}))
      ->needs(difference);
  sub->add_option("--sheet", arguments->sheet, sheet_help);
  add_file_limit(*sub, arguments->max_size, arguments->keep);
  sub->add_option("--steps", options.steps, "Simulate this many steps instead of the scenes' durations")
      ->check(whole_number_in({0, 1e9}));
  add_film_times(*sub, arguments->times,
                 sub->add_option("--frames", arguments->frames, "Only these frames of the film: A..B"));
  sub->add_option("--every", arguments->every,
                  "N: a frame after every N steps of the first motion instead of by its [video] fps and speed; 0.1s: "
                  "the same in time");
  add_style_option(*sub, options.style);
  add_quality_option(*sub, arguments->overrides);
  add_backend_option(*sub, options.backend);
  complete_command(
      *sub, command, [arguments, &common] { return run_compare(*arguments, common); },
      "compare a.toml b.toml -o ab.gif\n"
      "compare scene.toml --vary integrator.method=liu13,verlet\n"
      "compare a.toml b.toml --difference -o ab.html");
}

}  // namespace drape
