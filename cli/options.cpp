#include "cli/options.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "cli/inputs.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "output/registry.hpp"
#include "run/outputs.hpp"

namespace drape {

std::uint64_t parse_byte_count(const std::string& option, const std::string& text) {
  static const std::map<std::string, double> units{{"", 1},         {"B", 1},       {"kB", 1e3},     {"KB", 1e3},
                                                   {"MB", 1e6},     {"GB", 1e9},    {"kiB", 0x1p10}, {"KiB", 0x1p10},
                                                   {"MiB", 0x1p20}, {"GiB", 0x1p30}};
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  const std::string written(rest, end);
  const auto unit = units.find(written.substr(std::min(written.find_first_not_of(' '), written.size())));
  constexpr double largest = 1e18;
  if (error == std::errc() && unit != units.end()) {
    const double bytes = std::floor(number * unit->second);
    if (bytes >= 1 && bytes <= largest) return static_cast<std::uint64_t>(bytes);
  }
  throw UsageError(fmt::format("{} takes a size such as 5MB, 800kB or 1.5GiB; found '{}'", option, text));
}

std::vector<int> parse_frame_list(const std::string& text) {
  std::vector<int> frames;
  const char *at = text.data(), *const end = at + text.size();
  while (at != end) {
    int frame = -1;
    const auto [next, error] = std::from_chars(at, end, frame);
    const bool separated = next == end || (*next == ',' && next + 1 != end);
    if (error != std::errc() || frame < 0 || !separated) {
      throw UsageError(fmt::format("--frames takes frame numbers A,B,C, counted from 0; found '{}'", text));
    }
    frames.push_back(frame);
    at = next == end ? end : next + 1;
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

FrameRange parse_frames(const std::string& text) {
  FrameRange range;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, range.first);
  const bool two = first.ec == std::errc() && std::string_view(first.ptr, end).starts_with("..");
  const auto last = two ? std::from_chars(first.ptr + 2, end, range.last) : first;
  if (!two || last.ec != std::errc() || last.ptr != end || range.first < 0 || range.last < range.first) {
    throw UsageError(fmt::format("--frames takes A..B, two frame numbers with 0 ≤ A ≤ B; found '{}'", text));
  }
  return range;
}

SheetGrid parse_grid(const std::string& option, const std::string& text) {
  constexpr int most = 100;
  SheetGrid grid;
  const char* const end = text.data() + text.size();
  const auto columns = std::from_chars(text.data(), end, grid.columns);
  const bool two = columns.ec == std::errc() && std::string_view(columns.ptr, end).starts_with('x');
  const auto rows = two ? std::from_chars(columns.ptr + 1, end, grid.rows) : columns;
  const auto within = [](int count) { return count >= 1 && count <= most; };
  if (!two || rows.ec != std::errc() || rows.ptr != end || !within(grid.columns) || !within(grid.rows)) {
    throw UsageError(
        fmt::format("{} takes COLUMNSxROWS, each from 1 to {}, as in 4x3; found '{}'", option, most, text));
  }
  return grid;
}

std::optional<SheetGrid> parse_sheet(const std::string& text, const std::vector<std::string>& outputs) {
  if (text.empty()) return std::nullopt;
  const SheetGrid grid = parse_grid("--sheet", text);
  const auto becomes_sheet = [](const std::string& path) {
    const OutputFormat* format = find_format(path);
    return format != nullptr && format->drawn() && format->file_per_frame() && !PathTemplate(path).has_frame();
  };
  if (std::ranges::none_of(outputs, becomes_sheet)) {
    throw UsageError(fmt::format("--sheet {} needs an output for it: -o NAME.png", text));
  }
  return grid;
}

CLI::Validator on_one_line() {
  const auto problem = [](const std::string& text) -> std::string {
    const bool plain = std::ranges::none_of(text, [](unsigned char c) { return c < 0x20 || c == 0x7F; });
    return plain ? "" : fmt::format("expected a text without control characters, found '{}'", shown(text));
  };
  return CLI::Validator(problem, "");
}

namespace {

template <class Number>
std::optional<Number> parse(const std::string& text) {
  Number number{};
  const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

template <class Number>
CLI::Validator validator(const char* kind, const Range& range) {
  const auto problem = [kind, range](const std::string& text) -> std::string {
    const std::optional<Number> number = parse<Number>(text);
    if (number && std::isfinite(static_cast<double>(*number)) && range.contains(static_cast<double>(*number))) {
      return {};
    }
    return fmt::format("expected {} {}, found '{}'", kind, range.text(), text);
  };
  return CLI::Validator(problem, "");
}

}  // namespace

CLI::Validator number_in(const Range& range) { return validator<double>("a number", range); }

CLI::Validator whole_number_in(const Range& range) { return validator<std::int64_t>("a whole number", range); }

void add_quality_option(CLI::App& command, std::vector<std::string>& overrides) {
  command
      .add_option_function<std::string>(
          "--quality",
          [&overrides](const std::string& given) {
            const std::vector<std::string> names{"draft", "film", "print"};
            if (std::ranges::find(names, given) == names.end()) {
              throw CLI::ValidationError(
                  "--quality", "unknown quality '" + given + "'" + did_you_mean(given, names, "the choices are"));
            }
            overrides.push_back("look.quality=" + given);
          },
          "Size, samples and solver's tolerance in one word, relative to the scene's own")
      ->type_name("draft|film|print");
}

void add_style_option(CLI::App& subcommand, FigureStyle& style) {
  subcommand
      .add_option_function<std::string>(
          "--style",
          [&style](const std::string& given) {
            const std::vector<std::string> names(figure_style_names.begin(), figure_style_names.end());
            const auto found = std::ranges::find(names, given);
            if (found == names.end()) {
              throw CLI::ValidationError(
                  "--style", "unknown style '" + given + "'" + did_you_mean(given, names, "the styles are"));
            }
            style = static_cast<FigureStyle>(found - names.begin());
          },
          "Style of the diagrams' files; default screen. paper: for a column of an article, 3.3 in wide, without a "
          "title, in a serif font of 8 pt, as SVG, PDF and pgfplots; paper-wide: 7 in")
      ->type_name("screen|paper|paper-wide");
}

namespace {

constexpr double rounding = 1e-9;  // tolerance for decimal fractions, in frames or steps

}  // namespace

double parse_time(const std::string& option, const std::string& text) {
  double seconds = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, seconds);
  const std::string_view unit(rest, end);
  const bool known = unit == "s" || unit == "ms";
  if (error != std::errc() || !known || !std::isfinite(seconds) || seconds < 0) {
    throw UsageError(fmt::format("{} takes a time such as 2.5s or 250ms; found '{}'", option, text));
  }
  return unit == "ms" ? 1e-3 * seconds : seconds;
}

std::int64_t steps_in(const std::string& option, const std::string& text, double h) {
  const double steps = parse_time(option, text) / h, whole = std::round(steps);
  constexpr double most = 1e9;
  if (whole >= 1 && whole <= most && std::abs(steps - whole) <= rounding * whole) {
    return static_cast<std::int64_t>(whole);
  }
  const double below = std::clamp(std::floor(steps), 1.0, most);
  throw UsageError(fmt::format("{} {}: a step is {:g} s long; expected a whole number of them, such as {:g}s or {:g}s",
                               option, text, h, below * h, (below + 1) * h));
}

FrameRange frames_at(const FilmTimes& times, const FilmExtent& whole, const std::string& film) {
  const double end = whole.time(whole.frames.last);
  const auto frame_at = [&](const std::string& option, const std::string& text) {
    const double frame = parse_time(option, text) / whole.seconds_per_frame;
    if (frame <= whole.frames.last + 0.5) return frame;
    throw UsageError(fmt::format("{} {}: the film of {} ends at {:g} s", option, text, film, end));
  };
  FrameRange range = whole.frames;
  if (!times.at.empty()) {
    range.first = range.last = std::min(static_cast<int>(std::lround(frame_at("--at", times.at))), whole.frames.last);
  }
  if (!times.from.empty()) range.first = static_cast<int>(std::ceil(frame_at("--from", times.from) - rounding));
  if (!times.to.empty()) {
    range.last = std::min(static_cast<int>(std::floor(frame_at("--to", times.to) + rounding)), whole.frames.last);
  }
  if (range.first > range.last) {
    throw UsageError(fmt::format("there is no frame between {} and {}: frames are {:g} s apart",
                                 times.from.empty() ? "the start" : "--from " + times.from,
                                 times.to.empty() ? "the end" : "--to " + times.to, whole.seconds_per_frame));
  }
  return range;
}

void choose_frames(const FilmTimes& times, const LoadedScene& scene, RunOptions& options) {
  if (times.any()) options.frames = frames_at(times, whole_extent(scene, options), shown(scene.source.file));
}

void add_film_times(CLI::App& command, FilmTimes& times, CLI::Option* frames) {
  command.add_option("--at", times.at, "Only the frame nearest to this time of the scene: 2.5s")->excludes(frames);
  CLI::Option* const at = command.get_option("--at");
  command.add_option("--from", times.from, "Only frames from this time on: 1s")->excludes(frames)->excludes(at);
  command.add_option("--to", times.to, "Only frames up to this time: 2.5s")->excludes(frames)->excludes(at);
}

namespace {

constexpr const char* threads_help =
    "Threads that share a step where the cloth has 8192 vertices or more, with the same bits for any number: 1 to 256, "
    "or auto, one for each processor that drawing leaves, and fewer while other programs need them";

/// @returns 0 for auto: as many as are useful
int parse_threads(const std::string& text) {
  if (text == "auto") return 0;
  if (whole_number_in({1, 256})(text).empty()) return std::stoi(text);
  throw UsageError(fmt::format("--threads: expected auto or a whole number from 1 to 256, found '{}'", text));
}

/// Sets the outputs: films and frames, and separately the motion file.
void set_outputs(const RunArguments& arguments, const Scene& scene, const auto& expanded, RunOptions& options) {
  const RecordedSteps every =
      arguments.every.empty() ? RecordedSteps{} : parse_every(arguments.every, scene.simulation.step);
  if (!arguments.every.empty()) options.every = every.every;
  for (const std::string& output : arguments.outputs) {
    if (!is_motion_file(output)) {
      options.outputs.push_back(output);
    } else if (options.motion) {
      throw UsageError(fmt::format("-o {} and -o {}: a run writes only one motion file", options.motion->path, output));
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
      throw UsageError(fmt::format("'{}' is one file for the whole run: it cannot contain {{frame}}", text));
    return path.path(scene.name, 0, 1);
  };
  RunOptions options;
  set_outputs(arguments, scene, expanded, options);
  options.records = {.stats = expanded(arguments.records.stats),
                     .energies = expanded(arguments.records.energies),
                     .positions = expanded(arguments.records.positions),
                     .trace = expanded(arguments.records.trace)};
  options.steps = arguments.steps;
  if (!arguments.frames.empty()) options.frames = parse_frames(arguments.frames);
  options.largest_file = parse_file_limit(arguments.max_size, arguments.keep, arguments.outputs);
  if (arguments.poster) require_a_film("--poster", arguments.outputs);
  options.poster = arguments.poster;
  if (!arguments.start.empty()) require_a_film("--start", arguments.outputs);
  options.start_at_poster = arguments.start == "poster";
  options.sheet = parse_sheet(arguments.sheet, options.outputs);
  options.backend = arguments.backend;
  options.threads = parse_threads(arguments.threads);
  options.time_effects = verbose || !arguments.records.stats.empty();
  return options;
}

void add_file_limit(CLI::App& command, std::string& max_size, std::string& keep) {
  command.add_option("--max-size", max_size,
                     "Size limit for films, such as 5MB (or kB, GB, kiB, MiB, GiB): makes pictures smaller, then "
                     "fewer, until the film fits");
  command.add_option("--keep", keep, "Quantity that --max-size keeps, at the cost of the other: size or rate")
      ->check(CLI::IsMember({"size", "rate"}));
}

void require_a_film(const std::string& option, const std::vector<std::string>& outputs) {
  const auto is_film = [](const std::string& path) {
    const OutputFormat* format = find_format(path);
    return format != nullptr && format->drawn() && !format->file_per_frame();
  };
  if (std::ranges::any_of(outputs, is_film)) return;
  throw UsageError(option + " needs a film, and no -o is one; films are .gif, .webp, .mp4 and the like");
}

std::optional<FileLimit> parse_file_limit(const std::string& max_size, const std::string& keep,
                                          const std::vector<std::string>& outputs) {
  if (max_size.empty() && keep.empty()) return std::nullopt;
  if (max_size.empty()) throw UsageError("--keep " + keep + " needs --max-size");
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
      command.add_option("--set", arguments.overrides, "Override a value of the scene: key.path=value; repeatable"));
  add_quality_option(command, arguments.overrides);
  command.add_option("--steps", arguments.steps, "Simulate this many steps instead of the scene's duration")
      ->check(whole_number_in({0, 1e9}));
  add_film_times(command, arguments.times,
                 command.add_option("--frames", arguments.frames, "Only these frames of the film: A..B"));
  command.add_option("--every", arguments.every,
                     "N: a frame after every N steps instead of by [video] fps and speed; a .drape stores every step "
                     "by default, and with N every Nth. 0.1s: the same in time. frames: store only what the film's "
                     "frames need in a .drape");
  command
      .add_option("--checkpoint", arguments.checkpoint_seconds,
                  "Interval between checkpoints of a .drape: the most work lost if the run is killed, in s")
      ->check(number_in({.minimum = 0}))
      ->default_str("60");
  command.add_option("--resume", arguments.resume,
                     "Resume an interrupted or killed run that writes this motion, with the same bits; -o then makes "
                     "outputs of the whole motion");
  command.add_option("--stats", arguments.records.stats, "Write statistics of the run to a JSON file");
  command.add_option("--energies", arguments.records.energies, "Write the energies of every step to a CSV file");
  command.add_option("--positions", arguments.records.positions, "Write the final positions to a CSV file");
  command.add_option("--trace", arguments.records.trace,
                     "Write iterations, residual and time of every step to a CSV file");
  command.add_option("--threads", arguments.threads, threads_help)->default_str("auto");
  command.add_flag("--step-by-step", arguments.step_by_step, "Pause after each step and print its energies");
}

void add_outputs(CLI::App& command, RunArguments& arguments, const std::string& usage, bool drawn) {
  command
      .add_option(
          "-o,--output", arguments.outputs,
          fmt::format(
              "Output file; its extension selects the format ({}).\nA run that ends early, by Ctrl-C or divergence, "
              "writes NAME.partial.EXT instead, and for a .drape NAME.drape.partial, which --resume continues.\n{}",
              usage, output_help(drawn ? FormatKinds::all : FormatKinds::undrawn)))
      ->check(on_one_line())
      ->allow_extra_args(false);
}

}  // namespace drape
