#include "sweep/merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/error.hpp"
#include "core/text.hpp"
#include "sweep/run_sweep.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

constexpr const char* shard_prefix = "shard-";

bool is_part(const fs::path& folder, const char* mark) {
  std::error_code ignored;
  return fs::exists(folder / mark, ignored);
}

/// @throws UsageError that says in what two plans differ
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

/// A complete run's folder in another sweep, under a hidden name until all of it is there.
void take_over(const fs::path& from, const fs::path& to) {
  const fs::path hidden = to.parent_path() / ("." + to.filename().string());
  std::error_code error;
  fs::remove_all(hidden, error);
  fs::create_directories(hidden, error);
  for (const auto& entry : fs::directory_iterator(from, error)) {
    fs::create_hard_link(entry.path(), hidden / entry.path().filename(), error);
    if (error) fs::copy_file(entry.path(), hidden / entry.path().filename(), error);
    if (error) break;
  }
  if (!error) fs::remove_all(to, error);
  if (!error) fs::rename(hidden, to, error);
  if (!error) return;
  std::error_code ignored;
  fs::remove_all(hidden, ignored);
  throw OutputError(fmt::format("cannot write {}: {}", shown(to), error.message()));
}

}  // namespace

fs::path shard_place(const fs::path& folder, const Shard& shard) {
  return shard.whole() ? folder : folder / fmt::format("{}{}-of-{}", shard_prefix, shard.number, shard.count);
}

std::vector<fs::path> parts_in(const fs::path& folder, const char* mark) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().filename().string().starts_with(shard_prefix) && is_part(entry.path(), mark)) {
      found.push_back(entry);
    }
  }
  if (error == std::errc::not_a_directory) {
    throw UsageError(fmt::format("{}: this is a file; expected a folder with shards", shown(folder)));
  }
  if (error) throw UsageError(fmt::format("{}: cannot be read: {}", shown(folder), error.message()));
  std::ranges::sort(found);
  if (found.empty() && is_part(folder, mark)) found.push_back(folder);
  return found;
}

SweepFile merge_sweeps(const std::vector<fs::path>& parts, const fs::path& folder, const std::stop_token& stop) {
  std::optional<SweepFile> whole;
  for (const fs::path& part : parts) {
    const std::optional<SweepFile> file = read_sweep_file(part);
    if (!file) throw UsageError(fmt::format("{}: there is no sweep in it", shown(part)));
    if (whole) require_same(file->plan, part, whole->plan, parts.front());
    if (!whole) whole = file;
  }
  if (!whole) throw UsageError("there is nothing to merge");
  whole->shard = {};
  const SweepLock lock(folder);
  remove_unfinished(folder);
  write_sweep_file(folder, *whole);
  for (const PlannedRun& run : whole->plan.runs) {
    std::optional<RunRecord> has = read_run(folder, run.key);
    if (stop.stop_requested()) break;
    for (const fs::path& part : parts) {
      if (has && has->settled()) break;
      const std::optional<RunRecord> found = read_run(part, run.key);
      std::error_code ignored;
      const bool there = found && found->outcome != RunOutcome::not_run;
      if (!there || fs::equivalent(part, folder, ignored) || (has && !found->settled())) continue;
      take_over(run_place(part, run.key), run_place(folder, run.key));
      has = found;
    }
  }
  return *whole;
}

}  // namespace drape
