#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "check/candidate.hpp"
#include "cli/check_results.hpp"
#include "cli/interruption.hpp"
#include "cli/line_option.hpp"
#include "cli/studies.hpp"
#include "cli/sweep_results.hpp"
#include "core/error.hpp"
#include "core/read_file.hpp"
#include "core/shell.hpp"
#include "core/text.hpp"
#include "study/stability_runs.hpp"
#include "sweep/merge.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

struct MergeArguments {
  std::vector<std::string> folders;
  std::string output;
};

/// Brings what a shard has found of a scene, its pictures and what can be accepted, into the folder of the whole.
void take_over(const fs::path& part, const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::equivalent(part, folder, error)) return;
  fs::create_directories(folder, error);
  remove_candidate(folder, name);  // of an older check
  if (!fs::exists(part / name, error)) return;
  fs::copy(part / name, folder / name, fs::copy_options::recursive | fs::copy_options::overwrite_existing, error);
  if (error) throw OutputError(fmt::format("cannot write {}: {}", shown(folder / name), error.message()));
}

/// Whether a person has asked for an end. What is merged so far is complete, and merging again goes on.
bool interrupted() {
  if (!interruption().stop_requested()) return false;
  spdlog::error("interrupted: the same command completes it");
  return true;
}

ExitCode merge_checks(const std::vector<fs::path>& parts, const fs::path& folder, const CommonOptions& common) {
  constexpr std::size_t most_bytes = std::size_t{1} << 32;
  std::vector<CheckShard> shards;
  for (const fs::path& part : parts) {
    shards.push_back(unpack_shard(read_file(part / check_mark, most_bytes), part / check_mark));
    for (const SceneResult& result : shards.back().report.scenes) {
      if (interrupted()) return ExitCode::interrupted;
      take_over(part, folder, result.name);
    }
  }
  CheckShard whole = merge_shards(std::move(shards), parts);
  Verdicts verdicts;
  for (SceneResult& result : whole.report.scenes) {
    if (result.has_candidate()) {
      whole.report.accept_command = accept_command(folder);
      result.accept_command = accept_command(folder) + " " + shell_word(result.name);
    }
    tell(result, common, verdicts);
  }
  return conclude_check(whole, folder, common, verdicts);
}

/// What the shards in a folder are of.
/// @throws UsageError if there are none
const char* mark_in(const fs::path& folder) {
  for (const char* mark : {check_mark, stability_runs_name, sweep_mark}) {
    if (!parts_in(folder, mark).empty()) return mark;
  }
  throw UsageError(
      fmt::format("{}: there is no sweep, check or study of stability in it, nor a shard of one", shown(folder)));
}

ExitCode merge(const MergeArguments& arguments, const CommonOptions& common) {
  interruption();  // from here on, a signal ends it between two files
  const char* mark = mark_in(arguments.folders.front());
  std::vector<fs::path> parts;
  for (const std::string& folder : arguments.folders) {
    const std::vector<fs::path> found = parts_in(folder, mark);
    if (found.empty()) {
      throw UsageError(fmt::format("{}: there is neither a {} in it nor a shard of one", folder,
                                   mark == check_mark   ? "check"
                                   : mark == sweep_mark ? "sweep"
                                                        : "study of stability"));
    }
    parts.insert(parts.end(), found.begin(), found.end());
  }
  const fs::path folder = arguments.output.empty() ? arguments.folders.front() : arguments.output;
  if (mark == check_mark) return merge_checks(parts, folder, common);
  if (mark == stability_runs_name) return merge_stability_study(parts, folder, common);
  SweepFile whole = merge_sweeps(parts, folder, interruption().get_token());
  if (interrupted()) return ExitCode::interrupted;
  return conclude_sweep(read_results(folder, std::move(whole)), folder, common);
}

}  // namespace

void add_merge_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<MergeArguments>();
  CLI::App* sub = app.add_subcommand("merge", "Merge the shards of a sweep, check or study");
  sub->add_option("DIR", arguments->folders, "Folders of shards, or a folder with shards in it")->required();
  sub->add_option("-o,--output", arguments->output, "Folder for the merged result; default the first DIR")
      ->check(on_one_line());
  sub->callback(
      [arguments, &common, &command] { command = [arguments, &common] { return merge(*arguments, common); }; });
}

}  // namespace drape
