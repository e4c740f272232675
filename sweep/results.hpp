#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "run/shard.hpp"
#include "sweep/plan.hpp"
#include "sweep/run_folder.hpp"

namespace drape {

/// What a folder says that a sweep is: sweep.json.
struct SweepFile {
  SweepPlan plan;
  Shard shard;
};

/// @throws OutputError
void write_sweep_file(const std::filesystem::path& folder, const SweepFile& file);
/// @returns nothing if there is none
/// @throws UsageError if it is damaged, or of a version that writes another format
std::optional<SweepFile> read_sweep_file(const std::filesystem::path& folder);

/// Something in which the runs of a sweep differ: the scene, a key, or several keys that go together.
struct SweepAxis {
  std::string name;
  std::vector<std::string> values;  ///< each once, in their order
};

struct SweepRow {
  std::size_t run = 0;              ///< its place in the plan
  std::vector<std::size_t> places;  ///< of its values on each of the axes
  RunRecord record;
};

/// A sweep, and what became of its runs.
struct SweepResults {
  SweepPlan plan;
  Shard shard;
  std::vector<SweepAxis> axes;  ///< those with two values at least; the last is the one that goes across
  std::vector<SweepRow> rows;   ///< of the shard's runs, in the order of the plan

  [[nodiscard]] const PlannedRun& planned(const SweepRow& row) const { return plan.runs[row.run]; }
  [[nodiscard]] std::size_t count(RunOutcome outcome) const;
  /// "40 runs: 38 completed, 2 diverged"
  [[nodiscard]] std::string headline() const;
  /// Why runs are not complete, a sentence for each reason: "2 runs diverged, …". Of many the first, and how many more.
  [[nodiscard]] std::vector<std::string> troubles() const;
};

/// Reads what the folders of a sweep's runs say.
/// @param unwritten what became of runs whose folders could not be written, by their place in the plan
SweepResults read_results(const std::filesystem::path& folder, SweepFile file,
                          const std::map<std::size_t, RunRecord>& unwritten = {});

/// Rows that differ on two axes alone: the last, across, and the one before it, down.
struct SweepGrid {
  std::string title;                                     ///< what they have in common; empty: there is but this grid
  const SweepAxis* down = nullptr;                       ///< null: there is one row
  const SweepAxis* across = nullptr;                     ///< null: there is one column
  std::vector<std::vector<const SweepRow*>> cells = {};  ///< by row and column; null: there is no such run
};

std::vector<SweepGrid> grids_of(const SweepResults& results);

}  // namespace drape
