#include "cli/study_command.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "cli/command_line.hpp"
#include "cli/options.hpp"
#include "cli/terminal.hpp"
#include "core/console.hpp"
#include "core/files.hpp"
#include "core/machine.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "study/homework.hpp"
#include "study/known_answers.hpp"
#include "study/motions.hpp"
#include "study/scaling.hpp"
#include "study/stability.hpp"
#include "study/validation.hpp"
#include "study/validation_measures.hpp"

namespace drape {
namespace {

struct HomeworkArguments {
  StudyFiles files{.folder = "out/homework"};
  RunCount runs;
};

ExitCode run_homework(const HomeworkArguments& arguments, const CommonOptions& common) {
  return run_study(arguments.files, common, [&](const std::stop_token& stop, Progress& progress) {
    return report_of(study_homework(arguments.runs, stop, progress), homework_report, common);
  });
}

void add_homework_study(CLI::App& study, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<HomeworkArguments>();
  CLI::App* homework =
      study.add_subcommand("homework", "Measure the homework's tables again and compare with its report");
  add_study_files(*homework, arguments->files);
  homework->add_option("--runs", arguments->runs, runs_help)->check(whole_number_in({1, 1000}));
  complete_command(
      *homework, command, [arguments, &common] { return run_homework(*arguments, common); },
      "study homework --runs 3 -o out/homework");
}

}  // namespace

void add_study_files(CLI::App& subcommand, StudyFiles& files) {
  subcommand.add_option("-o,--output", files.folder, "Folder for the results; default " + files.folder)
      ->check(on_one_line());
  add_style_option(subcommand, files.style);
}

ExitCode run_study(const StudyFiles& files, const CommonOptions& common,
                   const std::function<std::optional<StudyReport>(const std::stop_token&, Progress&)>& measure) {
  require_writable(std::filesystem::path(files.folder) / report_page);  // fail before the measurements
  std::optional<StudyReport> report;
  run_watched(common.quiet, [&](const std::stop_token& stop, Progress& progress) { report = measure(stop, progress); });
  if (!report) {
    spdlog::error("interrupted: no report was written");
    return ExitCode::interrupted;
  }
  return conclude_study(*report, files, common);
}

ExitCode conclude_study(const StudyReport& report, const StudyFiles& files, const CommonOptions& common) {
  const std::filesystem::path folder = files.folder;
  const std::string problem = write_report(report, folder, files.style);
  if (!problem.empty()) spdlog::warn(problem);
  if (!common.quiet) {
    const std::size_t width = terminal(stdout, common.color).width;
    const std::string text = common.verbose ? to_text(report, width) + "\n" : to_summary(report, width);
    print_text(stdout, text + shown(folder / report_page) + "\n");
  }
  return ExitCode::ok;
}

void add_study_command(CLI::App& app, const CommonOptions& common, Command& command) {
  CLI::App* study = app.add_subcommand("study", "Measure accuracy, cost and stability, with diagrams and a page");
  study->require_subcommand(1);
  add_examples(*study,
               "study accuracy scene.toml\n"
               "study homework");
  add_homework_study(*study, common, command);
  add_accuracy_study(*study, common, command);
  add_scaling_study(*study, common, command);
  add_stability_study(*study, common, command);
  add_validation_study(*study, common, command);
}

namespace {

struct ScalingArguments {
  ScalingOptions options;
  StudyFiles files{.folder = "out/scaling"};
};

ExitCode run_scaling(const ScalingArguments& arguments, const CommonOptions& common) {
  return run_study(arguments.files, common, [&](const std::stop_token& stop, Progress& progress) {
    return report_of(study_scaling(arguments.options, stop, progress), scaling_report, common);
  });
}

}  // namespace

void add_scaling_study(CLI::App& study, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<ScalingArguments>();
  CLI::App* sub = study.add_subcommand("scaling", "Measure how time and memory grow with the cloth");
  sub->add_option("--grids", arguments->options.grids, "Cells per side of each grid; default 10,20,40,80")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(whole_number_in({1, 10000}));
  sub->add_option("--runs", arguments->options.runs, runs_help)->check(whole_number_in({1, 1000}));
  add_study_files(*sub, arguments->files);
  complete_command(
      *sub, command, [arguments, &common] { return run_scaling(*arguments, common); }, "study scaling --grids 20,40");
}

namespace {

struct StabilityArguments {
  StudyFiles files{.folder = "out/stability"};
  std::string shard;
  StabilityDetail detail;
};

/// Measures a shard and stores it for drape merge.
ExitCode run_shard(const StabilityArguments& arguments, const Shard& shard, const CommonOptions& common) {
  const std::filesystem::path file = shard_place(arguments.files.folder, shard) / stability_runs_name;
  require_writable(file);  // fail before the measurements
  StabilityStudy study = plan_stability(arguments.detail);
  const std::vector<std::size_t> parts = parts_of_shard(study, shard);
  bool complete = false;
  run_watched(common.quiet, [&](const std::stop_token& stop, Progress& progress) {
    complete = measure_stability(study, parts, stop, progress);
  });
  if (!complete) {
    spdlog::error("interrupted: nothing was written");
    return ExitCode::interrupted;
  }
  write_file_atomically(file, stability_runs(study, shard));
  if (!common.quiet) print_text(stdout, fmt::format("{} runs\n{}\n", parts.size(), shown(file)));
  return ExitCode::ok;
}

ExitCode run_stability(const StabilityArguments& arguments, const CommonOptions& common) {
  const Shard shard = arguments.shard.empty() ? Shard() : parse_shard(arguments.shard);
  if (!shard.whole()) return run_shard(arguments, shard, common);
  return run_study(arguments.files, common,
                   [&](const std::stop_token& stop, Progress& progress) -> std::optional<StudyReport> {
                     StabilityStudy study = plan_stability(arguments.detail);
                     if (!measure_stability(study, parts_of_shard(study, shard), stop, progress)) return std::nullopt;
                     return report_of(std::optional(study), stability_report, common);
                   });
}

}  // namespace

ExitCode merge_stability_study(const std::vector<std::filesystem::path>& parts, const StudyFiles& to,
                               const CommonOptions& common) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& part : parts) files.push_back(part / stability_runs_name);
  const MergedStability merged = merge_stability(files);
  for (const Shard& shard : merged.missing) spdlog::error("shard {} is missing: no report was written", shard.text());
  return merged.missing.empty() ? conclude_study(stability_report(merged.study), to, common) : ExitCode::interrupted;
}

void add_stability_study(CLI::App& study, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<StabilityArguments>();
  StabilityDetail& detail = arguments->detail;
  CLI::App* stability = study.add_subcommand("stability", "Map where each method is stable, converges or blows up");
  add_study_files(*stability, arguments->files);
  stability->add_option("--per-decade", detail.per_decade, "Time steps and stiffnesses per factor of ten; default 3")
      ->check(whole_number_in({1, 20}));
  stability->add_option("--steps", detail.steps, "Steps of every run; default 100")
      ->check(whole_number_in({1, 100000}));
  stability->add_option("--shard", arguments->shard,
                        "Run only the K-th of N parts of about equal length, for drape merge: K/N");
  complete_command(
      *stability, command, [arguments, &common] { return run_stability(*arguments, common); },
      "study stability --per-decade 2 -o out/maps");
}

namespace {

struct ValidationArguments {
  ValidationOptions options;
  int jobs = 0;
  StudyFiles files{.folder = "out/validation"};
  std::string shard;
  bool report_only = false, resume = false;
};

/// Returns the command line without options that change no result.
std::string command_line(const ValidationArguments& arguments) {
  std::string text = "drape study validation";
  for (const std::string& name : arguments.options.cases) text += " " + shell_word(name);
  std::string methods;
  for (const std::string& name : arguments.options.methods) methods.append(methods.empty() ? "" : ",").append(name);
  if (!methods.empty()) text += " --methods " + methods;
  return text + (arguments.options.quick ? " --quick" : "");
}

/// Returns the exit code of a report of validation, which may lack runs.
ExitCode judged(ExitCode code, const ValidationStudy& study) {
  if (code != ExitCode::ok) return code;
  if (study.missing() > 0) {
    spdlog::error("{} of {} runs are missing: --resume measures them", study.missing(), study.planned);
    return ExitCode::interrupted;
  }
  return all_met(study) ? code : ExitCode::differs;
}

/// Writes the report of existing measurements.
ExitCode validation_again(const ValidationArguments& arguments, const CommonOptions& common) {
  if (!arguments.options.cases.empty())
    throw UsageError("--report-only measures nothing: it takes no case, but -o with the folder");
  const ValidationStudy study = validation_study(std::filesystem::path(arguments.files.folder) / validation_runs_name);
  return judged(conclude_study(validation_report(study), arguments.files, common), study);
}

/// Measures a shard and stores it for drape merge.
ExitCode run_shard(ValidationStudy& study, const ValidationOptions& options, const std::filesystem::path& file,
                   const std::function<void()>& save, const CommonOptions& common) {
  require_writable(file);  // fail before the first run
  bool complete = false;
  run_watched(common.quiet, [&](const std::stop_token& stop, Progress& progress) {
    complete = measure_validation(study, options, stop, progress, save);
  });
  if (!complete) {
    spdlog::error("interrupted: --resume continues it");
    return ExitCode::interrupted;
  }
  save();
  if (!common.quiet) print_text(stdout, fmt::format("{} runs\n{}\n", study.runs.size(), shown(file)));
  return ExitCode::ok;
}

ExitCode run_validation(const ValidationArguments& arguments, const CommonOptions& common) {
  if (arguments.report_only) return validation_again(arguments, common);
  const auto begin = std::chrono::steady_clock::now();
  ValidationOptions options = arguments.options;
  if (!arguments.shard.empty()) options.shard = parse_shard(arguments.shard);
  const bool whole = options.shard.whole();
  const std::filesystem::path file =
      shard_place(arguments.files.folder, options.shard) / (whole ? validation_runs_name : validation_shard_name);
  options.jobs = arguments.jobs > 0 ? arguments.jobs : processors_left();
  ValidationStudy study = plan_validation(options);
  study.command = command_line(arguments);
  study.typed_command = common.command;
  study.provenance = study_provenance();
  if (arguments.resume && std::filesystem::exists(file)) read_validation_runs(file, study);
  const double before = study.seconds;
  std::optional<std::size_t> kept;  // number of motions in their file
  const auto save = [&] {
    study.seconds = before + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const auto motions = static_cast<std::size_t>(
        std::ranges::count_if(study.runs, [](const ValidationRun& run) { return run.played.frames > 0; }));
    if (motions != kept) write_file_atomically(file.parent_path() / motions_name, validation_motions(study));
    kept = motions;
    write_file_atomically(file, validation_runs(study));
  };
  if (!whole) return run_shard(study, options, file, save, common);
  const ExitCode code = run_study(arguments.files, common,
                                  [&](const std::stop_token& stop, Progress& progress) -> std::optional<StudyReport> {
                                    if (!measure_validation(study, options, stop, progress, save)) return std::nullopt;
                                    save();
                                    return validation_report(study);
                                  });
  return judged(code, study);
}

}  // namespace

ExitCode merge_validation_study(const std::vector<std::filesystem::path>& parts, const StudyFiles& to,
                                const CommonOptions& common) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& part : parts) files.push_back(part / validation_shard_name);
  const MergedValidation merged = merge_validation(files);
  for (const Shard& shard : merged.missing) spdlog::error("shard {} is missing: no report was written", shard.text());
  if (!merged.missing.empty()) return ExitCode::interrupted;
  write_file_atomically(std::filesystem::path(to.folder) / motions_name, validation_motions(merged.study));
  write_file_atomically(std::filesystem::path(to.folder) / validation_runs_name, validation_runs(merged.study));
  return judged(conclude_study(validation_report(merged.study), to, common), merged.study);
}

void add_validation_study(CLI::App& study, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<ValidationArguments>();
  ValidationOptions& options = arguments->options;
  CLI::App* sub = study.add_subcommand("validation", "Compare with problems whose answers are known");
  sub->add_option("CASE", options.cases, "Cases of scenes/validation; default all");
  sub->add_option("--methods", options.methods, "Methods of the runs that vary the method: M1,M2; default all")
      ->delimiter(',')
      ->allow_extra_args(false);
  sub->add_flag("--quick", options.quick, "Run a few problems as their scenes are, without defaults and variants");
  sub->add_option("--jobs", arguments->jobs, "Runs at once; default one for each free processor")
      ->check(whole_number_in({1, 1000}));
  sub->add_option("--patience", options.patience, "Computing time in s after which a run is given up; default 30")
      ->check(number_in({.minimum = 0, .minimum_excluded = true}));
  add_study_files(*sub, arguments->files);
  sub->add_option("--shard", arguments->shard,
                  "Run only the K-th of N parts of about equal length, for drape merge: K/N");
  sub->add_flag("--resume", arguments->resume,
                "Keep the runs that an interrupted run of the same command has finished in the folder");
  sub->add_flag("--report-only", arguments->report_only,
                "Measure nothing: recreate the report from the folder's runs.csv");
  complete_command(
      *sub, command, [arguments, &common] { return run_validation(*arguments, common); },
      "study validation\n"
      "study validation pendulum catenary --methods implicit-sdirk2 -o out/two");
}

namespace {

struct ValidateArguments {
  std::string name, file, problem;
};

ExitCode run_validate(const ValidateArguments& arguments, const CommonOptions& common) {
  const ValidationCase of = validation_cases({arguments.name}).front();
  std::string text;
  std::size_t met = 0;
  const std::vector<GivenAnswer> answers = read_answers(of, arguments.file, arguments.problem);
  for (const GivenAnswer& one : answers) {
    text += fmt::format("{} {}: {:.6g}, known {:.6g}, off by {:.2g}, allowed {:.2g}: {}\n", one.problem->name,
                        one.known->name, one.value, one.known->value, std::abs(one.value - one.known->value),
                        one.known->tolerance, one.met() ? "met" : "not met");
    met += one.met() ? 1 : 0;
  }
  text += fmt::format("{} of {} answers are met\n", met, answers.size());
  if (!common.quiet) print_text(stdout, text);
  return met == answers.size() ? ExitCode::ok : ExitCode::differs;
}

}  // namespace

void add_validate_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<ValidateArguments>();
  CLI::App* sub = app.add_subcommand("validate", "Judge an answer to a problem whose answer is known");
  sub->add_option("CASE", arguments->name, "A case of scenes/validation")->required();
  sub->add_option("ANSWER", arguments->file,
                  "CSV with the columns problem,quantity,value; or NPZ with positions and times of one motion")
      ->required();
  sub->add_option("--problem", arguments->problem, "Problem of the case that the motion in an NPZ file is of");
  complete_command(
      *sub, command, [arguments, &common] { return run_validate(*arguments, common); },
      "validate heavy-cantilever answers.csv\n"
      "validate catenary motion.npz --problem span-1.2");
}

}  // namespace drape
