#include <memory>

#include "cli/line_option.hpp"
#include "cli/number_option.hpp"
#include "cli/studies.hpp"
#include "study/scaling_report.hpp"

namespace drape {
namespace {

struct ScalingArguments {
  ScalingOptions options;
  std::string folder = "out/scaling";
};

ExitCode run_scaling(const ScalingArguments& arguments, const CommonOptions& common) {
  return run_study(arguments.folder, common, [&](const std::stop_token& stop, Progress& progress) {
    return report_of(study_scaling(arguments.options, stop, progress), scaling_report);
  });
}

}  // namespace

void add_scaling_study(CLI::App& study, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<ScalingArguments>();
  CLI::App* sub = study.add_subcommand("scaling", "Measure how time and memory grow with the cloth");
  sub->add_option("--largest", arguments->options.largest, "Cells per side of the largest grid; default 80")
      ->check(whole_number_in({10, 10000}));
  sub->add_option("--runs", arguments->options.runs, runs_help)->check(whole_number_in({1, 1000}));
  sub->add_option("-o,--output", arguments->folder, "Folder for the results; default out/scaling")
      ->check(on_one_line());
  sub->callback(
      [arguments, &common, &command] { command = [arguments, &common] { return run_scaling(*arguments, common); }; });
}

}  // namespace drape
