#include "sweep/merge.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "sweep/run_sweep.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

/// @throws UsageError that names the difference of two plans
void require_same(const SweepPlan& plan, const fs::path& from, const SweepPlan& first, const fs::path& first_from) {
  if (plan.program != first.program) {
    throw UsageError(fmt::format("{} was made by {}, and {} by {}: one sweep is made by one program", shown(from),
                                 shown(plan.program), shown(first_from), shown(first.program)));
  }
  const nlohmann::ordered_json a = plan_json(plan), b = plan_json(first);
  for (const auto& [key, value] : a.items()) {
    if (value != b.at(key)) {
      throw UsageError(
          fmt::format("{} and {} are not of one sweep: they differ in '{}'", shown(from), shown(first_from), key));
    }
  }
}

/// Makes a hard link to a file, or a copy if that is impossible.
void copy_or_link(const fs::directory_entry& from, const fs::path& to, std::error_code& error) {
  const bool is_link = from.is_symlink(error);  // copy links, whose target may be outside
  if (!is_link) fs::create_hard_link(from.path(), to, error);
  if (is_link || error) fs::copy_file(from.path(), to, error);
}

/// Copies or links a complete run's folder into another sweep, under a hidden name until it is complete.
void take_over(const fs::path& from, const fs::path& to) {
  const fs::path hidden = to.parent_path() / ("." + to.filename().string());
  std::error_code error;
  fs::remove_all(hidden, error);
  fs::create_directories(hidden, error);
  for (const auto& entry : fs::directory_iterator(from, error)) {
    if (!entry.is_regular_file(error)) continue;  // a run writes only files
    copy_or_link(entry, hidden / entry.path().filename(), error);
    if (error) break;
  }
  if (!error) fs::remove_all(to, error);
  if (!error) fs::rename(hidden, to, error);
  if (!error) return;
  std::error_code ignored;
  fs::remove_all(hidden, ignored);
  throw OutputError(fmt::format("cannot write {}: {}", shown(to), error.message()));
}

/// The state of a run in a folder, from worst to best.
enum class Found { damaged, unsettled, settled };

/// States by the keys of runs.
using FoundRuns = std::map<std::string, Found>;

/// A part of a sweep, read completely before anything is written.
struct SweepPart {
  fs::path folder;
  SweepFile file;
  FoundRuns runs;
};

/// Adds the state of a run in a sweep's folder, if it has one.
void note_run(const fs::path& sweep, const std::string& key, FoundRuns& runs) {
  const std::optional<RunRecord> record = read_run(sweep, key);
  if (!record) return;
  if (record->damaged) {
    runs.emplace(key, Found::damaged);
  } else if (record->outcome != RunOutcome::not_run) {
    runs.emplace(key, record->settled() ? Found::settled : Found::unsettled);
  }
}

SweepPart read_part(const fs::path& folder) {
  require_links_inside(folder);
  std::optional<SweepFile> file = read_sweep_file(folder);
  if (!file) throw UsageError(fmt::format("{}: there is no sweep in it", shown(folder)));
  SweepPart part{.folder = folder, .file = std::move(*file), .runs = {}};
  for (const PlannedRun& run : part.file.plan.runs) note_run(folder, run.key, part.runs);
  return part;
}

/// Returns the runs that are already in the folder of the whole.
/// @throws UsageError if links lead out of the folder
FoundRuns runs_already_in(const fs::path& folder, const SweepPlan& plan) {
  FoundRuns runs;
  for (const PlannedRun& run : plan.runs) {
    if (run.key.empty()) continue;
    require_inside(run_place(folder, run.key), folder);
    note_run(folder, run.key, runs);
  }
  return runs;
}

}  // namespace

SweepFile merge_sweeps(const std::vector<fs::path>& folders, const fs::path& folder, const std::stop_token& stop) {
  std::vector<SweepPart> parts;
  for (const fs::path& part : folders) {
    parts.push_back(read_part(part));
    const SweepPart& first = parts.front();
    require_same(parts.back().file.plan, part, first.file.plan, first.folder);
  }
  if (parts.empty()) throw UsageError("there is nothing to merge");
  SweepFile whole = parts.front().file;
  whole.shard = {};
  require_inside(folder / "runs", folder);
  FoundRuns merged = runs_already_in(folder, whole.plan);
  const SweepLock lock(folder);
  remove_unfinished(folder);
  write_sweep_file(folder, whole);
  for (const PlannedRun& run : whole.plan.runs) {
    if (stop.stop_requested()) break;
    for (const SweepPart& part : parts) {
      const auto has = merged.find(run.key);
      const auto found = part.runs.find(run.key);
      std::error_code ignored;
      if (found == part.runs.end() || fs::equivalent(part.folder, folder, ignored)) continue;
      if (has != merged.end() && found->second <= has->second) continue;
      take_over(run_place(part.folder, run.key), run_place(folder, run.key));
      merged.insert_or_assign(run.key, found->second);
    }
  }
  return whole;
}

}  // namespace drape
