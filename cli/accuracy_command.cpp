#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "cli/number_option.hpp"
#include "cli/scene_files.hpp"
#include "cli/studies.hpp"
#include "core/nearest.hpp"
#include "core/shell.hpp"
#include "overlay/fonts.hpp"
#include "render/gl/inspect.hpp"
#include "run/outputs.hpp"
#include "study/accuracy_animation.hpp"
#include "study/accuracy_report.hpp"

namespace drape {
namespace {

struct AccuracyArguments {
  std::vector<std::string> scenes, methods;
  std::vector<std::string> animations{"tolerances"};
  AccuracyOptions options;
  GlBackend backend = GlBackend::automatic;
  std::string folder = "out/accuracy";
};

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text.append(text.empty() ? "" : ",").append(name);
  return text;
}

/// The place of a name in a list.
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

std::string numbers(const char* option, const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text.append(text.empty() ? "" : ",").append(plain_number(value));
  return text.empty() ? text : fmt::format(" {} {}", option, text);
}

/// The command line again.
std::string command_line(const AccuracyArguments& arguments) {
  std::string text = "drape study accuracy";
  for (const std::string& scene : arguments.scenes) text += " " + shell_word(scene);
  for (const std::string& value : arguments.options.overrides) text += " --set " + shell_word(value);
  if (!arguments.methods.empty()) text += " --methods " + joined(arguments.methods);
  text += numbers("--tolerances", arguments.options.tolerances) + numbers("--steps", arguments.options.steps) +
          numbers("--times", arguments.options.times);
  return text + fmt::format(" --runs {} --animate {}", arguments.options.runs, joined(arguments.animations));
}

ExitCode run_accuracy(const AccuracyArguments& arguments, const CommonOptions& common) {
  const auto begin = std::chrono::steady_clock::now();
  AccuracyOptions options = arguments.options;
  options.methods = parse_methods(arguments.methods);
  const std::vector<AnimatedBy> animations = parse_animations(arguments.animations);
  const std::vector<Scene> scenes = load_scenes(arguments.scenes, options.overrides);
  // What is wrong is said before hours of work.
  for (const std::string& file : arguments.scenes) check_accuracy(file, options);
  if (!animations.empty()) {
    inspect_backend(arguments.backend);
    const Fonts fonts;
    for (const Scene& scene : scenes) require_texture(scene);
  }
  const std::vector<std::string> names = unique_names(scenes);
  return run_study(
      arguments.folder, common, [&](const std::stop_token& stop, Progress& progress) -> std::optional<StudyReport> {
        std::vector<SceneAccuracy> studies;
        std::vector<std::vector<StudyPicture>> pictures(scenes.size());
        for (std::size_t i = 0; i < scenes.size(); ++i) {
          auto study = study_accuracy(names[i], arguments.scenes[i], options, stop, progress);
          if (!study) return std::nullopt;
          for (const AnimatedBy animated : animations) {
            auto picture = animate_accuracy(*study, animated, arguments.folder, arguments.backend, stop, progress);
            if (picture) pictures[i].push_back(std::move(*picture));
          }
          if (stop.stop_requested()) return std::nullopt;
          studies.push_back(std::move(*study));
        }
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        return accuracy_report(studies, command_line(arguments), pictures, took.count());
      });
}

}  // namespace

void add_accuracy_study(CLI::App& study, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<AccuracyArguments>();
  AccuracyOptions& options = arguments->options;
  CLI::App* sub = study.add_subcommand("accuracy", "Measure cost against error, by method, tolerance and time step");
  const Range positive{.minimum = 0, .minimum_excluded = true};
  const auto list = [](CLI::Option* option) { return option->delimiter(',')->allow_extra_args(false); };
  sub->add_option("SCENE", arguments->scenes, "Scene files (TOML)")->required();
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
  list(sub->add_option(
      "--animate", arguments->animations,
      "What varies between the panels of the animations: tolerances (default), methods, steps, or none"));
  add_backend_option(*sub, arguments->backend);
  sub->add_option("--runs", options.runs, "Timed runs per case; default 5")->check(whole_number_in({1, 1000}));
  sub->add_option("-o,--output", arguments->folder, "Folder for the results; default out/accuracy");
  sub->callback(
      [arguments, &common, &command] { command = [arguments, &common] { return run_accuracy(*arguments, common); }; });
}

}  // namespace drape
