#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/studies.hpp"
#include "cli/watched.hpp"
#include "study/stability_report.hpp"

namespace drape {
namespace {

ExitCode run_stability(const std::string& folder, const StabilityDetail& detail, const CommonOptions& common) {
  std::optional<StabilityStudy> study;
  run_watched(common, [&](const std::stop_token& stop, Progress& progress) {
    study = study_stability(detail, stop, progress);
  });
  if (!study) {
    spdlog::error("interrupted; nothing was written");
    return ExitCode::interrupted;
  }
  const std::string problem = write_stability_files(*study, folder);
  if (!problem.empty()) spdlog::warn(problem);
  if (!common.quiet) {
    fmt::print("{}\n{}\n", stability_text(*study), (std::filesystem::path(folder) / "report.html").string());
  }
  return ExitCode::ok;
}

}  // namespace

void add_stability_study(CLI::App& study, const CommonOptions& common, Command& command) {
  auto folder = std::make_shared<std::string>("out/stability");
  auto detail = std::make_shared<StabilityDetail>();
  CLI::App* stability = study.add_subcommand("stability", "Map where each method is stable, converges or blows up");
  stability->add_option("-o,--output", *folder, "Folder for the results; default out/stability");
  stability->add_option("--per-decade", detail->per_decade, "Steps and stiffnesses in a factor of ten; default 2")
      ->check(CLI::Range(1, 20));
  stability->add_option("--steps", detail->steps, "Of every run; default 100")->check(CLI::Range(1, 100000));
  stability->callback([folder, detail, &common, &command] {
    command = [folder, detail, &common] { return run_stability(*folder, *detail, common); };
  });
}

}  // namespace drape
