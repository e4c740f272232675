#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <string>

#include "cli/background_work.hpp"
#include "cli/line_option.hpp"
#include "cli/number_option.hpp"
#include "cli/studies.hpp"
#include "core/atomic_file.hpp"
#include "core/console.hpp"
#include "core/text.hpp"
#include "study/stability_report.hpp"
#include "study/stability_runs.hpp"
#include "sweep/merge.hpp"

namespace drape {
namespace {

struct StabilityArguments {
  std::string folder = "out/stability", shard;
  StabilityDetail detail;
};

/// Measures a shard and stores it for drape merge.
ExitCode run_shard(const StabilityArguments& arguments, const Shard& shard, const CommonOptions& common) {
  const std::filesystem::path file = shard_place(arguments.folder, shard) / stability_runs_name;
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
  return run_study(arguments.folder, common,
                   [&](const std::stop_token& stop, Progress& progress) -> std::optional<StudyReport> {
                     StabilityStudy study = plan_stability(arguments.detail);
                     if (!measure_stability(study, parts_of_shard(study, shard), stop, progress)) return std::nullopt;
                     return stability_report(study);
                   });
}

}  // namespace

ExitCode merge_stability_study(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& folder,
                               const CommonOptions& common) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& part : parts) files.push_back(part / stability_runs_name);
  const MergedStability merged = merge_stability(files);
  for (const Shard& shard : merged.missing) spdlog::error("shard {} is missing: no report was written", shard.text());
  return merged.missing.empty() ? conclude_study(stability_report(merged.study), folder, common)
                                : ExitCode::interrupted;
}

void add_stability_study(CLI::App& study, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<StabilityArguments>();
  StabilityDetail& detail = arguments->detail;
  CLI::App* stability = study.add_subcommand("stability", "Map where each method is stable, converges or blows up");
  stability->add_option("-o,--output", arguments->folder, "Folder for the results; default out/stability")
      ->check(on_one_line());
  stability->add_option("--per-decade", detail.per_decade, "Time steps and stiffnesses per factor of ten; default 3")
      ->check(whole_number_in({1, 20}));
  stability->add_option("--steps", detail.steps, "Steps of every run; default 100")
      ->check(whole_number_in({1, 100000}));
  stability->add_option("--shard", arguments->shard,
                        "Run only the K-th of N parts of about equal length, for drape merge: K/N");
  stability->callback(
      [arguments, &common, &command] { command = [arguments, &common] { return run_stability(*arguments, common); }; });
}

}  // namespace drape
