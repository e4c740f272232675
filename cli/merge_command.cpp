#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "check/candidate.hpp"
#include "cli/check_results.hpp"
#include "cli/interruption.hpp"
#include "cli/line_option.hpp"
#include "cli/studies.hpp"
#include "cli/sweep_results.hpp"
#include "core/error.hpp"
#include "core/names_in_folders.hpp"
#include "core/read_file.hpp"
#include "core/shell.hpp"
#include "core/text.hpp"
#include "study/stability_runs.hpp"
#include "study/validation_runs.hpp"
#include "sweep/merge.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

struct MergeArguments {
  std::vector<std::string> folders;
  std::string output;
};

/// Copies files and folders recursively; follows links, skips special files.
void copy_files(const fs::path& from, const fs::path& to, std::error_code& error) {
  fs::create_directories(to, error);
  for (const auto& entry : fs::directory_iterator(from, error)) {
    const fs::path target = to / entry.path().filename();
    if (entry.is_directory(error) && !entry.is_symlink(error)) {
      copy_files(entry.path(), target, error);
    } else if (entry.is_regular_file(error)) {
      fs::copy_file(entry.path(), target, fs::copy_options::overwrite_existing, error);
    }
    if (error) return;
  }
}

/// Copies a shard's results of a scene, pictures and candidates, into the merged folder.
void take_over(const fs::path& part, const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::equivalent(part, folder, error)) return;
  fs::create_directories(folder, error);
  remove_candidate(folder, name);  // left from an older check
  if (!fs::exists(part / name, error)) return;
  copy_files(part / name, folder / name, error);
  if (error) throw OutputError(fmt::format("cannot write {}: {}", shown(folder / name), error.message()));
}

/// Returns true if a stop was requested. Merging can be repeated: merged results are complete.
bool interrupted() {
  if (!interruption().stop_requested()) return false;
  spdlog::error("interrupted: the same command completes it");
  return true;
}

/// @throws UsageError if it is damaged, or names a missing file
CheckShard read_shard(const fs::path& part) {
  constexpr std::size_t most_bytes = std::size_t{1} << 32;
  const fs::path file = part / check_mark;
  require_links_inside(part);
  CheckShard shard = unpack_shard(read_file(file, most_bytes), file);
  for (const SceneResult& scene : shard.report.scenes) {
    if (std::ranges::find(check_report_files, scene.name) == check_report_files.end()) continue;
    throw UsageError(fmt::format("{}: a scene is called as the report's {}", shown(file), scene.name));
  }
  return shard;
}

ExitCode merge_checks(const std::vector<fs::path>& parts, const fs::path& folder, const CommonOptions& common) {
  std::vector<CheckShard> shards;
  std::vector<std::pair<fs::path, std::string>> found;  // parts and their scenes
  for (const fs::path& part : parts) {
    shards.push_back(read_shard(part));
    for (const SceneResult& result : shards.back().report.scenes) found.emplace_back(part, result.name);
  }
  CheckShard whole = merge_shards(std::move(shards), parts);
  for (const auto& [part, name] : found) require_own_candidate(folder, name);
  for (const auto& [part, name] : found) {
    if (interrupted()) return ExitCode::interrupted;
    take_over(part, folder, name);
  }
  ResultPrinter verdicts;
  for (SceneResult& result : whole.report.scenes) {
    if (result.has_candidate()) {
      whole.report.accept_command = accept_command(folder);
      result.accept_command = accept_command(folder) + " " + shell_word(result.name);
    }
    tell(result, common, verdicts);
  }
  return conclude_check(whole, folder, common, verdicts);
}

/// Returns the kind of shards in a folder, by its marker file.
/// @throws UsageError if there are none
const char* mark_in(const fs::path& folder) {
  for (const char* mark : {check_mark, stability_runs_name, validation_shard_name, sweep_mark}) {
    if (!parts_in(folder, mark).empty()) return mark;
  }
  throw UsageError(fmt::format(
      "{}: there is no sweep, check or study of stability or validation in it, nor a shard of one", shown(folder)));
}

ExitCode merge(const MergeArguments& arguments, const CommonOptions& common) {
  interruption();  // from here on, a signal stops between two files
  for (const std::string& folder : arguments.folders) require_links_inside(folder);
  const char* mark = mark_in(arguments.folders.front());
  std::vector<fs::path> parts;
  for (const std::string& folder : arguments.folders) {
    const std::vector<fs::path> found = parts_in(folder, mark);
    if (found.empty()) {
      throw UsageError(fmt::format("{}: there is neither a {} in it nor a shard of one", folder,
                                   mark == check_mark            ? "check"
                                   : mark == sweep_mark          ? "sweep"
                                   : mark == stability_runs_name ? "study of stability"
                                                                 : "study of validation"));
    }
    parts.insert(parts.end(), found.begin(), found.end());
  }
  const fs::path folder = arguments.output.empty() ? arguments.folders.front() : arguments.output;
  if (mark == check_mark) return merge_checks(parts, folder, common);
  if (mark == stability_runs_name) return merge_stability_study(parts, folder, common);
  if (mark == validation_shard_name) return merge_validation_study(parts, folder, common);
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
