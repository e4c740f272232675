#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <chrono>
#include <memory>

#include "cli/inputs.hpp"
#include "cli/options.hpp"
#include "cli/study_command.hpp"
#include "core/console.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/render/overlay/pen.hpp"
#include "drape/scene/scene.hpp"
#include "render/gl/context.hpp"
#include "run/outputs.hpp"
#include "study/accuracy_report.hpp"
#include "study/accuracy_runs.hpp"

namespace drape {
namespace {

struct AccuracyArguments {
  std::vector<std::string> scenes, methods;
  std::vector<std::string> animations{"tolerances"};
  std::vector<std::string> parts;  ///< empty: all
  AccuracyOptions options;
  StudyFiles files{.folder = "out/accuracy"};
  bool report_only = false, resume = false;
};

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text.append(text.empty() ? "" : ",").append(name);
  return text;
}

/// Returns the index of a name in a list.
std::size_t parse_name(const char* option, const std::string& name, const std::vector<std::string>& known,
                       const char* kind) {
  const auto found = std::find(known.begin(), known.end(), name);
  if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
  throw UsageError(fmt::format("{}: unknown '{}'{}", option, name, did_you_mean(name, known, kind)));
}

std::vector<AnimatedBy> parse_animations(const std::vector<std::string>& names) {
  std::vector<std::string> known(animated_by_names.begin(), animated_by_names.end());
  known.emplace_back("none");
  std::vector<AnimatedBy> animations;
  for (const std::string& name : names) {
    const std::size_t place = parse_name("--animate", name, known, "the choices are");
    if (place < animated_by_names.size()) animations.push_back(static_cast<AnimatedBy>(place));
  }
  return animations;
}

std::vector<StepMethod> parse_methods(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const StepMethod method : step_methods) known.push_back(step_method_name(method));
  std::vector<StepMethod> methods;
  for (const std::string& name : names) {
    const StepMethod method = step_methods.at(parse_name("--methods", name, known, "the methods are"));
    if (std::find(methods.begin(), methods.end(), method) == methods.end()) methods.push_back(method);
  }
  return methods;
}

AccuracyParts parse_parts(const std::vector<std::string>& names) {
  if (names.empty()) return {.films = true};
  std::vector<std::string> known;
  for (const auto& [name, part] : accuracy_parts) known.emplace_back(name);
  AccuracyParts parts{false, false, false, false, false};
  for (const std::string& name : names) {
    parts.*accuracy_parts.at(parse_name("--parts", name, known, "the parts are")).second = true;
  }
  if (parts.films && !parts.asked) throw UsageError("--parts: films requires asked, whose runs it draws");
  if (parts.estimates && !parts.asked) throw UsageError("--parts: estimates requires asked, whose runs it judges");
  return parts;
}

std::string numbers(const char* option, const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text.append(text.empty() ? "" : ",").append(plain_number(value));
  return text.empty() ? text : fmt::format(" {} {}", option, text);
}

/// Returns the command line without options that change no result.
std::string command_line(const AccuracyArguments& arguments) {
  std::string text = "drape study accuracy";
  for (const std::string& scene : arguments.scenes) text += " " + shell_file(scene);
  for (const std::string& value : arguments.options.overrides) text += " --set " + shell_word(value);
  if (!arguments.methods.empty()) text += " --methods " + joined(arguments.methods);
  text += numbers("--tolerances", arguments.options.tolerances) + numbers("--steps", arguments.options.steps) +
          numbers("--times", arguments.options.times) + numbers("--accuracies", arguments.options.accuracies);
  if (!arguments.parts.empty()) text += " --parts " + joined(arguments.parts);
  if (arguments.options.patience != AccuracyOptions{}.patience)
    text += " --patience " + plain_number(arguments.options.patience);
  return text + runs_option(arguments.options.runs) + " --animate " + joined(arguments.animations);
}

/// Writes the report of existing measurements.
ExitCode report_again(const AccuracyArguments& arguments, const CommonOptions& common) {
  if (!arguments.scenes.empty())
    throw UsageError("--report-only measures nothing: it takes no scene, but -o with the folder");
  return conclude_study(accuracy_report(read_runs(arguments.files.folder)), arguments.files, common);
}

/// Reads the results of an interrupted study in the folder, if any.
/// @throws UsageError if they are from another study
AccuracyStudy begun_study(const std::string& folder, const std::string& command) {
  if (!std::filesystem::exists(std::filesystem::path(folder) / runs_name)) return {};
  AccuracyStudy begun = read_runs(folder);
  if (begun.command == command) return begun;
  throw UsageError(fmt::format("--resume: {} is of another command: {}",
                               (std::filesystem::path(folder) / runs_name).string(), begun.command));
}

/// Copies a scene's results from an interrupted study, if present and measured of the same scene. @returns true if
/// copied
bool take_over(AccuracyStudy& begun, const std::string& name, const LoadedScene& scene, AccuracyStudy& study) {
  const auto found = std::ranges::find(begun.scenes, name, &SceneAccuracy::name);
  if (found == begun.scenes.end()) return false;
  if (found->digest != scene.source.digest) {
    spdlog::warn("{} has changed since it was measured, and is measured again", shown(scene.source.file));
    return false;
  }
  study.pictures.push_back(std::move(begun.pictures[static_cast<std::size_t>(found - begun.scenes.begin())]));
  study.scenes.push_back(std::move(*found));
  return true;
}

ExitCode run_accuracy(const AccuracyArguments& arguments, const CommonOptions& common) {
  if (arguments.report_only) return report_again(arguments, common);
  if (arguments.scenes.empty()) throw UsageError("expected a scene file, or --report-only");
  const auto begin = std::chrono::steady_clock::now();
  AccuracyOptions options = arguments.options;
  options.methods = parse_methods(arguments.methods);
  options.parts = parse_parts(arguments.parts);
  options.of_several_scenes = arguments.scenes.size() > 1;
  const std::vector<AnimatedBy> animations = parse_animations(arguments.animations);
  const std::vector<LoadedScene> scenes = load_scenes(arguments.scenes, options.overrides);
  // Report input errors before hours of work.
  for (const std::string& file : arguments.scenes) check_accuracy(file, options);
  if (!animations.empty() || options.parts.films) {
    inspect_backend(options.backend);
    if (!animations.empty()) const Fonts fonts;
    for (const LoadedScene& scene : scenes) require_texture(scene);
  }
  AccuracyStudy study;
  study.command = command_line(arguments);
  study.provenance = study_provenance();
  const std::vector<std::string> names = unique_names(scenes);
  AccuracyStudy begun = arguments.resume ? begun_study(arguments.files.folder, study.command) : AccuracyStudy{};
  study.typed_command = begun.typed_command.empty() ? common.command : begun.typed_command;
  study.seconds = begun.seconds;
  return run_study(
      arguments.files, common, [&](const std::stop_token& stop, Progress& progress) -> std::optional<StudyReport> {
        for (std::size_t i = 0; i < scenes.size(); ++i) {
          if (take_over(begun, names[i], scenes[i], study)) continue;
          std::optional<SceneAccuracy> one;
          try {
            one = study_accuracy(names[i], arguments.scenes[i], options, stop, progress);
          } catch (const DivergedError& error) {
            if (i + 1 == scenes.size() && study.scenes.empty()) throw;
            spdlog::warn("{} is left out: {}", arguments.scenes[i], error.what());
            continue;
          }
          if (!one) return std::nullopt;
          one->digest = scenes[i].source.digest;
          std::vector<StudyPicture>& pictures = study.pictures.emplace_back();
          for (const AnimatedBy animated : animations) {
            auto picture = animate_accuracy(*one, animated, arguments.files.folder, options.backend, stop, progress);
            if (picture) pictures.push_back(std::move(*picture));
          }
          if (stop.stop_requested()) return std::nullopt;
          study.scenes.push_back(std::move(*one));
          // Save now, so that measurements survive an early end.
          study.seconds =
              begun.seconds + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
          write_runs(study, arguments.files.folder);
        }
        return accuracy_report(study);
      });
}

}  // namespace

void add_accuracy_study(CLI::App& study, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<AccuracyArguments>();
  AccuracyOptions& options = arguments->options;
  CLI::App* sub = study.add_subcommand("accuracy", "Measure cost against error, by method, tolerance and time step");
  const Range positive{.minimum = 0, .minimum_excluded = true};
  const auto list = [](CLI::Option* option) { return option->delimiter(',')->allow_extra_args(false); };
  sub->add_option("SCENE", arguments->scenes, "Scene files (TOML)");
  sub->add_option("--set", options.overrides, "Override a value of the scenes: key.path=value; repeatable")
      ->allow_extra_args(false);
  list(sub->add_option("--methods", arguments->methods, "Methods: M1,M2; default all"));
  list(sub->add_option("--tolerances", options.tolerances, "Tolerances: E1,E2; default 1 to 1e-7"))
      ->check(number_in(positive));
  list(sub->add_option("--steps", options.steps, "Time steps in s: H1,H2; default the scene's, halved repeatedly"))
      ->check(number_in(positive));
  list(sub->add_option("--times", options.times,
                       "Times in s at which motions are compared: T1,T2 (time steps at T1 only); default 1/20, 1/8 and "
                       "1/4 of the scene's duration"))
      ->check(number_in(positive));
  list(sub->add_option("--accuracies", options.accuracies, "Requested accuracies in m: A1,A2; default 1e-2,1e-3,1e-4"))
      ->check(number_in(positive));
  list(
      sub->add_option("--parts", arguments->parts,
                      "Parts to measure: solve (errors by tolerance), order (by time step), asked ([time] accuracy and "
                      "fixed steps), estimates (accuracy of the errors that these steps report), films (how "
                      "different they look); default all"));
  list(sub->add_option(
      "--animate", arguments->animations,
      "Difference between the panels of the animations: tolerances (default), methods, steps, or none"));
  add_backend_option(*sub, options.backend);
  sub->add_option("--runs", options.runs, runs_help)->check(whole_number_in({1, 1000}));
  add_study_files(*sub, arguments->files);
  sub->add_option("--patience", options.patience,
                  "Computing time in s after which a motion of 'asked' is given up; default 20")
      ->check(number_in(positive));
  sub->add_flag("--resume", arguments->resume,
                "Keep the scenes that an interrupted run of the same command has finished in the folder");
  sub->add_flag("--report-only", arguments->report_only,
                "Measure nothing: recreate the report from the folder's runs.csv");
  complete_command(
      *sub, command, [arguments, &common] { return run_accuracy(*arguments, common); },
      "study accuracy scene.toml\n"
      "study accuracy scene.toml --methods liu13,quasi-newton --tolerances 1e-2,1e-4\n"
      "study accuracy scene.toml --animate methods -o out/methods");
}

}  // namespace drape
