#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <optional>

#include "cli/background_work.hpp"
#include "cli/line_option.hpp"
#include "cli/number_option.hpp"
#include "cli/studies.hpp"
#include "cli/terminal.hpp"
#include "core/atomic_file.hpp"
#include "core/console.hpp"
#include "core/text.hpp"
#include "study/homework_report.hpp"

namespace drape {
namespace {

struct HomeworkArguments {
  std::string folder = "out/homework";
  RunCount runs;
};

ExitCode run_homework(const HomeworkArguments& arguments, const CommonOptions& common) {
  return run_study(arguments.folder, common, [&](const std::stop_token& stop, Progress& progress) {
    return report_of(study_homework(arguments.runs, stop, progress), homework_report);
  });
}

void add_homework_study(CLI::App& study, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<HomeworkArguments>();
  CLI::App* homework =
      study.add_subcommand("homework", "Measure the homework's tables again and compare with its report");
  homework->add_option("-o,--output", arguments->folder, "Folder for the results; default out/homework")
      ->check(on_one_line());
  homework->add_option("--runs", arguments->runs, runs_help)->check(whole_number_in({1, 1000}));
  homework->callback(
      [arguments, &common, &command] { command = [arguments, &common] { return run_homework(*arguments, common); }; });
}

}  // namespace

ExitCode run_study(const std::filesystem::path& folder, const CommonOptions& common,
                   const std::function<std::optional<StudyReport>(const std::stop_token&, Progress&)>& measure) {
  require_writable(folder / report_page);  // fail before the measurements
  std::optional<StudyReport> report;
  run_watched(common.quiet, [&](const std::stop_token& stop, Progress& progress) { report = measure(stop, progress); });
  if (!report) {
    spdlog::error("interrupted: no report was written");
    return ExitCode::interrupted;
  }
  return conclude_study(*report, folder, common);
}

ExitCode conclude_study(const StudyReport& report, const std::filesystem::path& folder, const CommonOptions& common) {
  const std::string problem = write_report(report, folder);
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
  add_homework_study(*study, common, command);
  add_accuracy_study(*study, common, command);
  add_scaling_study(*study, common, command);
  add_stability_study(*study, common, command);
  add_validation_study(*study, common, command);
}

}  // namespace drape
