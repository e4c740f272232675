#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "cli/background_work.hpp"
#include "cli/line_option.hpp"
#include "cli/number_option.hpp"
#include "cli/studies.hpp"
#include "core/atomic_file.hpp"
#include "core/console.hpp"
#include "core/error.hpp"
#include "core/processors.hpp"
#include "core/shell.hpp"
#include "core/text.hpp"
#include "study/validation_report.hpp"
#include "study/validation_runs.hpp"
#include "sweep/merge.hpp"

namespace drape {
namespace {

struct ValidationArguments {
  ValidationOptions options;
  int jobs = 0;
  std::string folder = "out/validation", shard;
  bool report_only = false, resume = false;
};

/// Returns the command line without options that do not change the result.
std::string command_line(const ValidationArguments& arguments) {
  std::string text = "drape study validation";
  for (const std::string& name : arguments.options.cases) text += " " + shell_word(name);
  std::string methods;
  for (const std::string& name : arguments.options.methods) methods.append(methods.empty() ? "" : ",").append(name);
  if (!methods.empty()) text += " --methods " + methods;
  return text + (arguments.options.quick ? " --quick" : "");
}

ExitCode unless_missed(ExitCode code, bool met) { return code == ExitCode::ok && !met ? ExitCode::differs : code; }

/// Writes the report of existing measurements.
ExitCode validation_again(const ValidationArguments& arguments, const CommonOptions& common) {
  if (!arguments.options.cases.empty())
    throw UsageError("--report-only measures nothing: it takes no case, but -o with the folder");
  const ValidationStudy study = validation_study(std::filesystem::path(arguments.folder) / validation_runs_name);
  return unless_missed(conclude_study(validation_report(study), arguments.folder, common), all_met(study));
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
      shard_place(arguments.folder, options.shard) / (whole ? validation_runs_name : validation_shard_name);
  options.jobs = arguments.jobs > 0 ? arguments.jobs : processors_left();
  ValidationStudy study = plan_validation(options);
  study.command = command_line(arguments);
  study.provenance = study_provenance();
  if (arguments.resume && std::filesystem::exists(file)) read_validation_runs(file, study);
  const double before = study.seconds;
  const auto save = [&] {
    study.seconds = before + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    write_file_atomically(file, validation_runs(study));
  };
  if (!whole) return run_shard(study, options, file, save, common);
  const ExitCode code = run_study(arguments.folder, common,
                                  [&](const std::stop_token& stop, Progress& progress) -> std::optional<StudyReport> {
                                    if (!measure_validation(study, options, stop, progress, save)) return std::nullopt;
                                    save();
                                    return validation_report(study);
                                  });
  return unless_missed(code, all_met(study));
}

}  // namespace

ExitCode merge_validation_study(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& folder,
                                const CommonOptions& common) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& part : parts) files.push_back(part / validation_shard_name);
  const MergedValidation merged = merge_validation(files);
  for (const Shard& shard : merged.missing) spdlog::error("shard {} is missing: no report was written", shard.text());
  if (!merged.missing.empty()) return ExitCode::interrupted;
  write_file_atomically(folder / validation_runs_name, validation_runs(merged.study));
  return unless_missed(conclude_study(validation_report(merged.study), folder, common), all_met(merged.study));
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
  sub->add_option("-o,--output", arguments->folder, "Folder for the results; default out/validation")
      ->check(on_one_line());
  sub->add_option("--shard", arguments->shard,
                  "Run only the K-th of N parts of about equal length, for drape merge: K/N");
  sub->add_flag("--resume", arguments->resume,
                "Keep the runs that an interrupted run of the same command has finished in the folder");
  sub->add_flag("--report-only", arguments->report_only,
                "Measure nothing: recreate the report from the folder's runs.csv");
  sub->callback([arguments, &common, &command] {
    command = [arguments, &common] { return run_validation(*arguments, common); };
  });
}

}  // namespace drape
