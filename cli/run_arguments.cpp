#include "cli/run_arguments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/byte_count.hpp"
#include "cli/frame_list.hpp"
#include "cli/grid_option.hpp"
#include "cli/motion_runs.hpp"
#include "cli/number_option.hpp"
#include "core/error.hpp"
#include "output/path_template.hpp"
#include "output/registry.hpp"

namespace drape {
namespace {

/// Sets the outputs: films and frames, and the motion file apart from them.
void set_outputs(const RunArguments& arguments, const auto& expanded, RunOptions& options) {
  const RecordedSteps every = arguments.every.empty() ? RecordedSteps{} : parse_every(arguments.every);
  if (!arguments.every.empty()) options.every = every.every;
  for (const std::string& output : arguments.outputs) {
    if (!is_motion_file(output)) {
      options.outputs.push_back(output);
    } else if (options.motion) {
      throw UsageError(fmt::format("-o {} and -o {}: a run writes one motion file", options.motion->path, output));
    } else {
      options.motion = {
          .path = expanded(output), .recorded = every, .checkpoint_seconds = arguments.checkpoint_seconds};
    }
  }
}

}  // namespace

RunOptions run_options(const RunArguments& arguments, const Scene& scene, bool verbose) {
  const auto expanded = [&](const std::string& text) {
    const PathTemplate path(text);
    if (path.has_frame())
      throw UsageError(fmt::format("'{}' is one file for the whole run: it cannot hold {{frame}}", text));
    return path.path(scene.name, 0, 1);
  };
  RunOptions options;
  set_outputs(arguments, expanded, options);
  options.records = {.stats = expanded(arguments.records.stats),
                     .energies = expanded(arguments.records.energies),
                     .positions = expanded(arguments.records.positions),
                     .trace = expanded(arguments.records.trace)};
  options.steps = arguments.steps;
  if (!arguments.frames.empty()) options.frames = parse_frames(arguments.frames);
  options.largest_file = parse_file_limit(arguments.max_size, arguments.keep, arguments.outputs);
  if (arguments.poster) require_a_film("--poster", arguments.outputs);
  options.poster = arguments.poster;
  options.sheet = parse_sheet(arguments.sheet, options.outputs);
  options.backend = arguments.backend;
  options.time_effects = verbose || !arguments.records.stats.empty();
  return options;
}

void add_file_limit(CLI::App& command, std::string& max_size, std::string& keep) {
  command.add_option("--max-size", max_size,
                     "5MB: make a film's pictures smaller, then fewer, until it has no more bytes; also kB, GB, kiB, "
                     "MiB, GiB");
  command.add_option("--keep", keep, "size or rate: what --max-size leaves as it is, so that the other gives")
      ->check(CLI::IsMember({"size", "rate"}));
}

void require_a_film(const std::string& option, const std::vector<std::string>& outputs) {
  const auto is_film = [](const std::string& path) {
    const OutputFormat* format = find_format(path);
    return format != nullptr && format->drawn() && !format->file_per_frame();
  };
  if (std::ranges::any_of(outputs, is_film)) return;
  throw UsageError(option + " is for films, and no -o is one, such as .gif, .webp or .mp4");
}

std::optional<FileLimit> parse_file_limit(const std::string& max_size, const std::string& keep,
                                          const std::vector<std::string>& outputs) {
  if (max_size.empty() && keep.empty()) return std::nullopt;
  if (max_size.empty()) throw UsageError("--keep " + keep + " is for a film that must fit: give --max-size, too");
  require_a_film("--max-size", outputs);
  return FileLimit{.bytes = parse_byte_count("--max-size", max_size),
                   .keeps = keep == "size"   ? FilmKeeps::size
                            : keep == "rate" ? FilmKeeps::rate
                                             : FilmKeeps::nothing};
}

void add_shared_options(CLI::App& command, RunArguments& arguments, const char* scenes) {
  command.add_option("SCENE", arguments.scenes, scenes);
  const auto one_each = [](CLI::Option* option) { option->allow_extra_args(false); };
  one_each(
      command.add_option("--set", arguments.overrides, "key.path=value: replaces a value of the scene; repeatable"));
  command.add_option("--steps", arguments.steps, "Simulate this many steps instead of the scene's duration")
      ->check(whole_number_in({0, 1e9}));
  command.add_option("--frames", arguments.frames, "A..B: only these frames of the film");
  command.add_option(
      "--every", arguments.every,
      "N: a frame after every N steps, instead of as [video] fps and speed say, and in a .drape, which has "
      "every step otherwise, as many; frames: in a .drape only what the film's frames need");
  command
      .add_option("--checkpoint", arguments.checkpoint_seconds,
                  "Seconds of work that are lost at most where a run that writes a .drape is killed")
      ->check(number_in({.minimum = 0}))
      ->default_str("60");
  command.add_option("--resume", arguments.resume,
                     "MOTION.drape: goes on with a run that was interrupted or killed, to the same bits; what -o asks "
                     "for is made of the whole motion then");
  command.add_option("--stats", arguments.records.stats, "Write the run's figures to a JSON file");
  command.add_option("--energies", arguments.records.energies, "Write the energies of every step to a CSV file");
  command.add_option("--positions", arguments.records.positions, "Write the last positions to a CSV file");
  command.add_option("--trace", arguments.records.trace,
                     "Write iterations, residual and time of every step to a CSV file");
  command.add_flag("--step-by-step", arguments.step_by_step, "Pause after each step and print its energies");
}

void add_outputs(CLI::App& command, RunArguments& arguments, const std::string& usage, bool drawn) {
  command
      .add_option("-o,--output", arguments.outputs,
                  fmt::format("Where to, and by the extension in which form; {}.\nWhat ends early, by Ctrl-C or a "
                              "diverging motion, becomes NAME.partial.EXT; of a .drape, "
                              "NAME.drape.partial, which --resume goes on with.\n{}",
                              usage, output_help(drawn)))
      ->allow_extra_args(false);
}

}  // namespace drape
