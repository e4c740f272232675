#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <new>
#include <thread>

#include "check/candidate.hpp"
#include "check/check_scene.hpp"
#include "check/golden.hpp"
#include "check/manifest.hpp"
#include "check/name_difference.hpp"
#include "cli/command_line.hpp"
#include "cli/inputs.hpp"
#include "cli/options.hpp"
#include "cli/summary.hpp"
#include "cli/terminal.hpp"
#include "core/console.hpp"
#include "core/files.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "run/resources.hpp"
#include "run/shard.hpp"

namespace drape {
namespace {

struct CheckArguments {
  std::vector<std::string> scenes, overrides;
  std::string frames;
  std::string report = "out/check";
  std::string update = "missing";
  GlBackend backend = GlBackend::automatic;
  bool end_to_end = false;
  std::size_t threads = 0, jobs = 1;
  std::string shard;
  FigureStyle style = FigureStyle::screen;
  std::optional<double> motion_tolerance, pixels, flip;
  std::optional<int> channel;
};

UpdateMode parse_update(const std::string& name) {
  static const std::vector<std::string> names{"all", "missing", "none"};  // in the enumeration's order
  if (name == "changed") {
    throw UsageError(
        "--update changed no longer exists: look at the report of a check, then accept it with drape accept");
  }
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<UpdateMode>(found - names.begin());
  throw UsageError(fmt::format("--update: unknown '{}'{}", name, did_you_mean(name, names, "the choices are")));
}

/// Returns the scene's [check] settings with the command line's changes.
CheckSettings settings_of(const Scene& scene, const CheckArguments& arguments) {
  CheckSettings settings = scene.check;
  settings.motion_tolerance = arguments.motion_tolerance.value_or(settings.motion_tolerance);
  settings.limits.channel = arguments.channel.value_or(settings.limits.channel);
  settings.limits.pixels = arguments.pixels.value_or(settings.limits.pixels);
  settings.limits.flip = arguments.flip.value_or(settings.limits.flip);
  return settings;
}

/// Returns for example "--set cloth.mass=2 --set look.color=red".
std::string override_options(const CheckArguments& arguments) {
  std::string text;
  for (const std::string& value : arguments.overrides) {
    text += (text.empty() ? "--set " : " --set ") + shell_word(value);
  }
  return text;
}

std::string backend_option(const CheckArguments& arguments) {
  return arguments.backend == GlBackend::automatic ? "" : fmt::format(" --backend {}", backend_name(arguments.backend));
}

/// Returns the options that affect the results of a check.
std::string command_options(const CheckArguments& arguments) {
  std::string text = override_options(arguments);
  if (!text.empty()) text.insert(0, " ");
  if (!arguments.frames.empty()) text += " --frames " + arguments.frames;
  if (arguments.end_to_end) text += " --end-to-end";
  if (arguments.update != CheckArguments().update) text += " --update " + arguments.update;
  text += backend_option(arguments);
  if (arguments.motion_tolerance) text += fmt::format(" --motion-tolerance {}", *arguments.motion_tolerance);
  if (arguments.channel) text += fmt::format(" --channel-limit {}", *arguments.channel);
  if (arguments.pixels) text += fmt::format(" --pixel-limit {}", *arguments.pixels);
  if (arguments.flip) text += fmt::format(" --flip-limit {}", *arguments.flip);
  return text;
}

std::string report_option(const CheckArguments& arguments) {
  return arguments.report == CheckArguments().report ? "" : " --report " + shell_word(arguments.report);
}

/// Returns the options without effect on the result of a single scene.
std::string scene_run_options(const CheckArguments& arguments) {
  std::string text = report_option(arguments);
  if (arguments.style != FigureStyle::screen) text += fmt::format(" --style {}", name_of(arguments.style));
  return text + (arguments.threads > 0 ? fmt::format(" --threads {}", arguments.threads) : "");
}

/// Returns the options without effect on the results: report folder and parallelism.
std::string run_options(const CheckArguments& arguments) {
  std::string text = scene_run_options(arguments);
  if (arguments.jobs > 1) text += fmt::format(" --jobs {}", arguments.jobs);
  if (!arguments.shard.empty()) text += " --shard " + arguments.shard;
  return text;
}

/// Checker of scenes by index.
class SceneChecker {
 public:
  SceneChecker(const std::vector<LoadedScene>& scenes, const std::vector<std::shared_ptr<MotionReader>>& recorded,
               const CheckArguments& arguments, const CheckOptions& options)
      : scenes_(scenes),
        recorded_(recorded),
        arguments_(arguments),
        options_(options),
        names_(unique_names(scenes, {check_report_files.begin(), check_report_files.end()})) {}

  /// Checks a scene. Its errors become part of the result.
  [[nodiscard]] SceneResult judge(std::size_t place, const std::stop_token& stop, Progress& progress) const {
    const LoadedScene& scene = scenes_[place];
    const CheckSettings settings = settings_of(scene, arguments_);
    SceneResult result;
    try {
      std::optional<PlayedMotion> played;
      if (recorded_[place]) played.emplace(*recorded_[place]);
      result = check_scene(scene, names_[place], settings, options_, stop, progress, played ? &*played : nullptr);
    } catch (const Error& error) {
      result = unjudged_scene(scene, names_[place], settings, error);
    } catch (const std::bad_alloc&) {
      result = unjudged_scene(scene, names_[place], settings, UsageError("there is not enough memory for this"));
    }
    const std::string file = shell_file(scene.source.file.string());
    result.rerun_command = "drape check " + file + command_options(arguments_) + scene_run_options(arguments_);
    if (result.has_candidate()) {
      result.accept_command = accept_command(options_.artefacts) + " " + shell_file(result.name);
    } else if (arguments_.overrides.empty()) {
      result.accept_command = "drape bless " + file + backend_option(arguments_);
    }
    return result;
  }

  /// Returns the folder of the report.
  [[nodiscard]] const std::filesystem::path& folder() const { return options_.artefacts; }

 private:
  const std::vector<LoadedScene>& scenes_;
  const std::vector<std::shared_ptr<MotionReader>>& recorded_;  // null for simulated scenes
  const CheckArguments& arguments_;
  const CheckOptions& options_;
  std::vector<std::string> names_;
};

/// Checks the scenes at these indices, in sequence or in parallel, and adds the results to the report.
/// @returns true if interrupted
bool check_all(const SceneChecker& judge, const std::vector<std::size_t>& places, std::size_t jobs,
               const CommonOptions& common, ResultPrinter& verdicts, CheckReport& report) {
  const auto add = [&](SceneResult result) {
    if (result.has_candidate()) report.accept_command = accept_command(judge.folder());
    tell(result, common, verdicts);
    if (!result.checked_on.renderer.empty()) report.machine.renderer = result.checked_on.renderer;
    report.scenes.push_back(std::move(result));
  };
  if (jobs == 1) {
    for (const std::size_t place : places) {
      SceneResult result;
      const auto check = [&](const std::stop_token& stop, Progress& progress) {
        result = judge.judge(place, stop, progress);
      };
      if (run_watched(common.quiet, check)) return true;
      add(std::move(result));
    }
    return false;
  }
  std::vector<SceneResult> results(places.size());
  const auto check = [&](const std::stop_token& stop, Progress& progress) {
    progress.begin("checking", "scenes", static_cast<std::int64_t>(places.size()));
    for_each_in_parallel(jobs, places.size(), stop, [&](std::size_t, std::size_t i) {
      Progress unseen;
      results[i] = judge.judge(places[i], stop, unseen);
      ++progress.done;
    });
  };
  if (run_watched(common.quiet, check)) return true;
  for (SceneResult& result : results) add(std::move(result));
  return false;
}

/// Returns the scene indices of a shard. Shards have about equal estimated costs.
std::vector<std::size_t> places_of(const std::vector<LoadedScene>& scenes, const Shard& shard) {
  std::vector<double> costs;
  for (const Scene& scene : scenes) costs.push_back(estimated_cost(scene, {}));
  return runs_of_shard(costs, shard);
}

/// Returns the number of threads per scene that keeps all cores busy.
std::size_t threads_of(const CheckArguments& arguments) {
  if (arguments.threads > 0 || arguments.jobs == 1) return arguments.threads;
  return std::max<std::size_t>(1, std::thread::hardware_concurrency() / arguments.jobs);
}

/// @throws UsageError if the report would overwrite a golden folder
void require_no_golden(const std::filesystem::path& report) {
  std::error_code ignored;
  const bool is_golden = report.filename().extension() == ".golden" ||
                         std::filesystem::exists(report / "manifest.json", ignored) ||
                         std::filesystem::exists(report / "motion.bin", ignored);
  if (!is_golden) return;
  throw UsageError(fmt::format("--report {}: this is the folder of a golden; name another one", shown(report)));
}

/// @throws UsageError if goldens would be recorded with values other than the scene files'
void require_golden_values(const CheckOptions& options) {
  if (options.update != UpdateMode::all || options.overrides.empty()) return;
  throw UsageError("--update all records what the scene files say: edit them instead of giving " + options.overrides);
}

/// @throws OutputError
void remove_file(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::remove(file, error);
  if (error) throw OutputError(fmt::format("cannot remove {}: {}", shown(file), error.message()));
}

ExitCode check(const CheckArguments& arguments, const CommonOptions& common) {
  const auto begin = std::chrono::steady_clock::now();
  const Shard shard = arguments.shard.empty() ? Shard{} : parse_shard(arguments.shard);
  const std::filesystem::path folder = shard_place(arguments.report, shard);
  const CheckOptions options{.frames = parse_frame_list(arguments.frames),
                             .backend = arguments.backend,
                             .end_to_end = arguments.end_to_end,
                             .update = parse_update(arguments.update),
                             .threads = threads_of(arguments),
                             .artefacts = folder,
                             .overrides = override_options(arguments)};
  require_golden_values(options);
  require_no_golden(arguments.report);
  std::vector<LoadedScene> scenes;
  std::vector<std::shared_ptr<MotionReader>> recorded;
  for (SceneToRun& opened : open_scenes(arguments.scenes, arguments.overrides)) {
    scenes.push_back(std::move(opened.scene));
    recorded.push_back(std::move(opened.recorded));
  }
  for (const char* file : check_report_files) const PartialFile writable(folder / file);  // throws if not writable
  remove_file(folder / check_mark);  // an older result must not count if this check is killed

  CheckShard part{.report = {}, .places = places_of(scenes, shard), .scenes = scenes.size(), .shard = shard};
  CheckReport& report = part.report;
  report.date = utc_now();
  report.command = "drape check";
  for (const std::string& scene : arguments.scenes) report.command += " " + shell_file(scene);
  report.command += command_options(arguments);
  report.run_options = run_options(arguments);
  report.typed_command = common.command;
  report.overrides = options.overrides;
  ResultPrinter verdicts;
  const SceneChecker judge(scenes, recorded, arguments, options);
  if (check_all(judge, part.places, arguments.jobs, common, verdicts, report)) {
    spdlog::error("interrupted: no report was written");
    return ExitCode::interrupted;
  }
  report.machine = this_machine(report.machine.renderer);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const ExitCode code = conclude_check(report, folder, arguments.style, common, verdicts);
  if (!shard.whole()) write_file_atomically(folder / check_mark, pack_shard(part));
  return code;
}

void add_limits(CLI::App& sub, CheckArguments& arguments) {
  sub.add_option("--motion-tolerance", arguments.motion_tolerance,
                 "Largest accepted distance of a vertex from its golden position, m")
      ->check(number_in({.minimum = 0}));
  sub.add_option("--channel-limit", arguments.channel, "Largest accepted difference of a pixel in any channel, of 255")
      ->check(whole_number_in({0, 255}));
  sub.add_option("--pixel-limit", arguments.pixels, "Largest accepted fraction of pixels that differ at all")
      ->check(number_in({0, 1}));
  sub.add_option("--flip-limit", arguments.flip, "Largest accepted FLIP error of a pixel")->check(number_in({0, 1}));
}

}  // namespace

void add_check_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* sub = app.add_subcommand("check", "Compare scenes with their golden frames and motion");
  sub->add_option("SCENE", arguments->scenes, "Scene files (TOML), or motions: .drape, or what drape import reads")
      ->required();
  sub->add_option("--set", arguments->overrides, "Override a value of the scene: key.path=value; repeatable")
      ->allow_extra_args(false);
  sub->add_option("--frames", arguments->frames, "Compare only these golden frames: A,B,C");
  sub->add_flag("--end-to-end", arguments->end_to_end, "Also run and draw the whole motion");
  sub->add_option("--update", arguments->update, "Goldens to write; default missing, and such a check still fails")
      ->type_name("all|missing|none");
  add_backend_option(*sub, arguments->backend);
  sub->add_option("--report", arguments->report, "Folder for the report (HTML, JSON, JUnit); default out/check")
      ->check(on_one_line());
  add_style_option(*sub, arguments->style);
  sub->add_option("--threads", arguments->threads, "Number of windows of motion computed at once")
      ->check(whole_number_in({1, 1024}));
  sub->add_option("--jobs", arguments->jobs, "How many scenes are checked at once; default 1")
      ->check(whole_number_in({1, 1024}));
  sub->add_option("--shard", arguments->shard,
                  "K/N: check only the K-th of N parts that take about as long; drape merge puts them together");
  add_limits(*sub, *arguments);
  complete_command(
      *sub, command, [arguments, &common] { return check(*arguments, common); },
      "check scenes/*.toml\n"
      "check scenes/*.toml --update none      # in continuous integration\n"
      "check scene.toml --motion-tolerance 1e-5");
}

namespace {

struct BlessArguments {
  std::vector<std::string> scenes;
  std::string frames;
  GlBackend backend = GlBackend::automatic;
};

ExitCode bless(const BlessArguments& arguments, const CommonOptions& common) {
  const std::vector<int> frames = parse_frame_list(arguments.frames);
  const std::vector<SceneToRun> scenes = open_scenes(arguments.scenes, {});
  for (const auto& [scene, recorded] : scenes)
    has_golden(golden_folder(scene.source.file));  // check all before blessing any
  for (const SceneToRun& opened : scenes) {
    const LoadedScene& scene = opened.scene;
    CheckSettings settings = scene.check;
    if (!frames.empty()) settings.frames = frames;
    std::optional<Blessing> blessing;
    run_watched(common.quiet, [&](const std::stop_token& stop, Progress& progress) {
      std::optional<PlayedMotion> played;
      if (opened.recorded) played.emplace(*opened.recorded);
      blessing = bless_scene(scene, settings, arguments.backend, stop, progress, played ? &*played : nullptr);
    });
    if (!blessing) {
      spdlog::error("interrupted: {} is unchanged", shown(golden_folder(scene.source.file)));
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
  complete_command(
      *sub, command, [arguments, &common] { return bless(*arguments, common); },
      "bless scenes/*.toml\n"
      "bless scene.toml --frames 0,40,120");
}

namespace {

struct AcceptArguments {
  std::string report = "out/check";
  std::vector<std::string> scenes;
  std::string frames;
};

/// @throws UsageError unless the folder contains a report of drape check
void require_report(const std::filesystem::path& folder) {
  std::error_code error;
  const auto status = std::filesystem::status(folder, error);
  if (std::filesystem::exists(folder / check_report_files.front(), error)) return;
  throw UsageError(fmt::format(
      "{}: {}; expected the report folder of a check: drape check SCENE writes out/check, or what --report says",
      shown(folder),
      !std::filesystem::exists(status)        ? "no such folder"
      : std::filesystem::is_directory(status) ? "there is no report of drape check in this folder"
                                              : "this is a file"));
}

ExitCode accept(const AcceptArguments& arguments, const CommonOptions& common) {
  const std::vector<int> frames = parse_frame_list(arguments.frames);
  require_report(arguments.report);
  const std::vector<Candidate> candidates = find_candidates(arguments.report, arguments.scenes);
  for (const Candidate& candidate : candidates) require_acceptable(candidate, frames);  // before accepting any
  for (const Candidate& candidate : candidates) {
    const std::filesystem::path folder = accept_candidate(candidate, frames);
    if (common.quiet) continue;
    print_text(stdout,
               fmt::format("{}: accepted{}\n", shown(folder),
                           frames.empty() ? "" : fmt::format(": the pictures of the frames {}", arguments.frames)));
  }
  return ExitCode::ok;
}

}  // namespace

void add_accept_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<AcceptArguments>();
  CLI::App* sub = app.add_subcommand("accept", "Make what a failed check found the golden, without a new run");
  sub->add_option("REPORT", arguments->report, "Report folder of the check")->required();
  sub->add_option("SCENE", arguments->scenes, "Only these scenes: names in the report, or scene files");
  sub->add_option("--frames", arguments->frames,
                  "Only the pictures of these frames, if the motion is unchanged: A,B,C");
  complete_command(
      *sub, command, [arguments, &common] { return accept(*arguments, common); },
      "accept out/check\n"
      "accept out/check flag --frames 40");
}

}  // namespace drape
