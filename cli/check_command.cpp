#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <system_error>

#include "check/check_scene.hpp"
#include "check/html_report.hpp"
#include "check/json_report.hpp"
#include "check/junit_report.hpp"
#include "check/machine.hpp"
#include "cli/command_line.hpp"
#include "cli/frame_list.hpp"
#include "cli/number_option.hpp"
#include "cli/scene_files.hpp"
#include "cli/watched.hpp"
#include "core/atomic_file.hpp"
#include "core/nearest.hpp"
#include "core/shell.hpp"

namespace drape {
namespace {

struct CheckArguments {
  std::vector<std::string> scenes, overrides;
  std::string frames;
  std::string report = "out/check";
  std::string update = "missing";
  GlBackend backend = GlBackend::automatic;
  bool end_to_end = false;
  std::size_t threads = 0;
  std::optional<double> motion_tolerance, pixels, flip;
  std::optional<int> channel;
};

UpdateMode parse_update(const std::string& name) {
  static const std::vector<std::string> names{"all", "missing", "none"};  // as the enumeration
  if (name == "changed") {
    throw UsageError(
        "--update changed no longer exists: look at the report of a check, then accept it with drape accept");
  }
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<UpdateMode>(found - names.begin());
  throw UsageError(fmt::format("--update: unknown '{}'{}", name, did_you_mean(name, names, "the choices are")));
}

/// The table [check] of a scene with what the command line says.
CheckSettings settings_of(const Scene& scene, const CheckArguments& arguments) {
  CheckSettings settings = scene.check;
  settings.motion_tolerance = arguments.motion_tolerance.value_or(settings.motion_tolerance);
  settings.limits.channel = arguments.channel.value_or(settings.limits.channel);
  settings.limits.pixels = arguments.pixels.value_or(settings.limits.pixels);
  settings.limits.flip = arguments.flip.value_or(settings.limits.flip);
  return settings;
}

std::string command_options(const CheckArguments& arguments) {
  std::string text;
  for (const std::string& value : arguments.overrides) text += " --set " + shell_word(value);
  if (!arguments.frames.empty()) text += " --frames " + arguments.frames;
  if (arguments.end_to_end) text += " --end-to-end";
  if (arguments.backend != GlBackend::automatic) text += fmt::format(" --backend {}", backend_name(arguments.backend));
  if (arguments.motion_tolerance) text += fmt::format(" --motion-tolerance {}", *arguments.motion_tolerance);
  if (arguments.channel) text += fmt::format(" --channel-limit {}", *arguments.channel);
  if (arguments.pixels) text += fmt::format(" --pixel-limit {}", *arguments.pixels);
  if (arguments.flip) text += fmt::format(" --flip-limit {}", *arguments.flip);
  return text;
}

std::string accept_command(const CheckArguments& arguments) { return "drape accept " + shell_word(arguments.report); }

/// One line about a scene.
std::string describe(const SceneResult& scene) {
  const std::string file = scene.file.string();
  if (scene.verdict != SceneVerdict::passed) {
    return fmt::format("{}: {}: {}", file, verdict_name(scene.verdict), fmt::join(scene.findings, "; "));
  }
  std::string text =
      fmt::format("{}: passed: motion {}, {} {}", file, verdict_name(scene.windows.motion), scene.windows.frames.size(),
                  scene.windows.frames.size() == 1 ? "picture" : "pictures");
  text += fmt::format(" {}", verdict_name(scene.windows.picture));
  if (const std::string ignored = describe_ignored(scene); !ignored.empty()) text += fmt::format(" ({})", ignored);
  if (scene.end_to_end) {
    text += fmt::format("; end to end {}, {}", verdict_name(scene.end_to_end->motion),
                        verdict_name(scene.end_to_end->picture));
  }
  return text + fmt::format(" ({:.1f} s)", scene.seconds);
}

const std::array<const char*, 3> report_files{"report.html", "report.json", "junit.xml"};

void write_reports(const CheckReport& report, const std::filesystem::path& folder) {
  const auto& [html, json, junit] = report_files;
  write_html_report(report, folder / html);
  write_file_atomically(folder / json, json_report(report));
  write_file_atomically(folder / junit, junit_report(report));
  write_frame_files(report, folder);
}

/// Prints the verdicts, and remembers if one could not be printed.
class Verdicts {
 public:
  void print(const std::string& line) {
    if (std::fputs((line + "\n").c_str(), stdout) >= 0 && std::fflush(stdout) == 0) return;
    if (reason_.empty()) reason_ = std::generic_category().message(errno);
  }

  /// Why not all of them could be printed; empty: they could.
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

Ink ink_of(SceneVerdict verdict) {
  if (verdict == SceneVerdict::passed) return Ink::green;
  return verdict == SceneVerdict::changed || verdict == SceneVerdict::error ? Ink::red : Ink::yellow;
}

/// A line for the terminal, in which the verdict has a colour.
std::string shown(const SceneResult& result, const CommonOptions& common) {
  const Terminal where = terminal(stdout, common.color);
  const std::string line = wrapped(describe(result), where.width, 2), verdict = verdict_name(result.verdict);
  const std::size_t at = line.find(": " + verdict + ":");
  if (at == std::string::npos) return line;
  return line.substr(0, at + 2) + inked(verdict, ink_of(result.verdict), where) + line.substr(at + 2 + verdict.size());
}

void tell(const SceneResult& result, const CommonOptions& common, Verdicts& verdicts) {
  const bool good = result.passed();
  if (result.verdict == SceneVerdict::error) {
    spdlog::error(describe(result));
  } else if (!common.quiet || !good) {
    verdicts.print(shown(result, common));
  }
  for (const WindowResult& window : result.windows.windows) {
    spdlog::debug("steps {} to {}: {}", window.first_step, window.last_step, verdict_name(window.verdict));
  }
  for (const FrameResult& frame : result.windows.frames) {
    spdlog::debug("frame {}: {}, {} pixels differ, FLIP error up to {:.3f}", frame.frame,
                  verdict_name(frame.difference.verdict), frame.difference.pixels, frame.difference.max_flip);
  }
  if (!result.renderer.empty()) spdlog::debug("drawn by {}", result.renderer);
}

/// Judges every scene, whatever is wrong with another one.
/// @returns whether it was interrupted
bool check_all(const std::vector<Scene>& scenes, const CheckArguments& arguments, const CheckOptions& options,
               const CommonOptions& common, Verdicts& verdicts, CheckReport& report) {
  const std::vector<std::string> names = unique_names(scenes, {report_files.begin(), report_files.end()});
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene& scene = scenes[i];
    const CheckSettings settings = settings_of(scene, arguments);
    SceneResult result;
    const auto check = [&](const std::stop_token& stop, Progress& progress) {
      try {
        result = check_scene(scene, names[i], settings, options, stop, progress);
      } catch (const Error& error) {
        result = unjudged_scene(scene, names[i], settings, error);
      } catch (const std::bad_alloc&) {
        result = unjudged_scene(scene, names[i], settings, UsageError("there is not enough memory for this"));
      }
    };
    if (run_watched(common.quiet, check)) return true;
    const std::string file = shell_word(scene.file.string());
    result.rerun_command = "drape check " + file + command_options(arguments);
    // What was checked with other values than the file's is not what the file gives.
    result.has_candidate = result.has_candidate && arguments.overrides.empty();
    result.accept_command =
        result.has_candidate ? accept_command(arguments) + " " + shell_word(result.name) : "drape bless " + file;
    if (result.has_candidate) report.accept_command = accept_command(arguments);
    tell(result, common, verdicts);
    if (!result.renderer.empty()) report.machine.renderer = result.renderer;
    report.scenes.push_back(std::move(result));
  }
  return false;
}

ExitCode check(const CheckArguments& arguments, const CommonOptions& common) {
  const auto begin = std::chrono::steady_clock::now();
  const CheckOptions options{.frames = parse_frame_list(arguments.frames),
                             .backend = arguments.backend,
                             .end_to_end = arguments.end_to_end,
                             .update = parse_update(arguments.update),
                             .threads = arguments.threads,
                             .artefacts = arguments.report};
  const std::vector<Scene> scenes = load_scenes(arguments.scenes, arguments.overrides);
  const std::filesystem::path folder = arguments.report;
  for (const char* file : report_files) const PartialFile writable(folder / file);  // or it throws

  CheckReport report;
  report.date = utc_now();
  report.command = "drape check";
  for (const std::string& scene : arguments.scenes) report.command += " " + shell_word(scene);
  report.command += command_options(arguments);
  Verdicts verdicts;
  if (check_all(scenes, arguments, options, common, verdicts, report)) {
    spdlog::error("interrupted: no report was written");
    return ExitCode::interrupted;
  }
  report.machine = this_machine(report.machine.renderer);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  write_reports(report, folder);
  if (!common.quiet) verdicts.print((folder / "report.html").string());
  if (verdicts.reason().empty()) return exit_code(report);
  spdlog::error("cannot write the verdicts to standard output: {}", verdicts.reason());
  return std::max(exit_code(report), ExitCode::output);
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
  sub->add_option("SCENE", arguments->scenes, "Scene files (TOML)")->required();
  sub->add_option("--set", arguments->overrides, "Override a value of the scene: key.path=value; repeatable")
      ->allow_extra_args(false);
  sub->add_option("--frames", arguments->frames, "Compare only these golden frames: A,B,C");
  sub->add_flag("--end-to-end", arguments->end_to_end, "Also run and draw the whole motion");
  sub->add_option("--update", arguments->update,
                  "Which goldens to write: missing (default; such a check still fails), all or none")
      ->type_name("WHICH");
  add_backend_option(*sub, arguments->backend);
  sub->add_option("--report", arguments->report, "Folder for the report (HTML, JSON, JUnit); default out/check");
  sub->add_option("--threads", arguments->threads, "Number of windows of motion computed at once")
      ->check(whole_number_in({1, 1024}));
  add_limits(*sub, *arguments);
  sub->callback(
      [arguments, &common, &command] { command = [arguments, &common] { return check(*arguments, common); }; });
}

}  // namespace drape
