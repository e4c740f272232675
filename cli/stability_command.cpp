#include <memory>
#include <string>

#include "cli/number_option.hpp"
#include "cli/studies.hpp"
#include "study/stability_report.hpp"

namespace drape {
namespace {

ExitCode run_stability(const std::string& folder, const StabilityDetail& detail, const CommonOptions& common) {
  return run_study(folder, common, [&](const std::stop_token& stop, Progress& progress) {
    return report_of(study_stability(detail, stop, progress), stability_report);
  });
}

}  // namespace

void add_stability_study(CLI::App& study, const CommonOptions& common, Command& command) {
  auto folder = std::make_shared<std::string>("out/stability");
  auto detail = std::make_shared<StabilityDetail>();
  CLI::App* stability = study.add_subcommand("stability", "Map where each method is stable, converges or blows up");
  stability->add_option("-o,--output", *folder, "Folder for the results; default out/stability");
  stability->add_option("--per-decade", detail->per_decade, "Time steps and stiffnesses per factor of ten; default 3")
      ->check(whole_number_in({1, 20}));
  stability->add_option("--steps", detail->steps, "Steps of every run; default 100")
      ->check(whole_number_in({1, 100000}));
  stability->callback([folder, detail, &common, &command] {
    command = [folder, detail, &common] { return run_stability(*folder, *detail, common); };
  });
}

}  // namespace drape
