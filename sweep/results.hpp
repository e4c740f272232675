#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "run/shard.hpp"
#include "sweep/plan.hpp"
#include "sweep/run_folder.hpp"

namespace drape {

/// The file that marks the folder of a sweep and of its shards, see parts_in().
inline constexpr const char* sweep_mark = "sweep.json";

/// The contents of sweep.json, which identifies a sweep's folder.
struct SweepFile {
  SweepPlan plan;
  Shard shard;
};

/// Writes sweep.json.
/// @throws OutputError
void write_sweep_file(const std::filesystem::path& folder, const SweepFile& file);
/// Reads sweep.json.
/// @returns nothing if there is none
/// @throws UsageError if it is damaged or of another format version
std::optional<SweepFile> read_sweep_file(const std::filesystem::path& folder);

/// Merges the runs of several parts into one folder, as if one process had run them all. If several parts have a run, a
/// settled one wins. Files are hard links if the file system supports them, otherwise copies.
/// @param stop checked between runs; the remaining runs are then skipped
/// @returns the whole sweep
/// @throws UsageError  if the parts belong to different sweeps
/// @throws OutputError
SweepFile merge_sweeps(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& folder,
                       const std::stop_token& stop = {});

/// A property that varies between runs: the scene, a key, or several zipped keys.
struct SweepAxis {
  std::string name;
  std::vector<std::string> values;  ///< distinct, in order
};

struct SweepRow {
  std::size_t run = 0;              ///< index in the plan
  std::vector<std::size_t> places;  ///< index of its value on each axis
  RunRecord record;
};

/// A sweep with the results of its runs.
struct SweepResults {
  SweepPlan plan;
  Shard shard;
  std::vector<SweepAxis> axes;     ///< axes with at least two values; the last one runs across grids
  std::vector<SweepRow> rows;      ///< rows of the shard's runs, in the order of the plan
  std::string typed_command = {};  ///< command line as typed; empty: its runs are of earlier commands

  [[nodiscard]] const PlannedRun& planned(const SweepRow& row) const { return plan.runs[row.run]; }
  [[nodiscard]] std::size_t count(RunOutcome outcome) const;
  /// Returns "40 runs: 38 completed, 2 diverged".
  [[nodiscard]] std::string headline() const;
  /// Returns the command line as typed, or one for the whole plan.
  [[nodiscard]] std::string command() const;
  /// Returns a sentence per reason for incomplete runs: "2 runs diverged, …"; of many, the first 20 and a count.
  [[nodiscard]] std::vector<std::string> troubles() const;
};

/// Reads the results from the folders of a sweep's runs.
/// @param unwritten records of runs whose folders could not be written, by index in the plan
SweepResults read_results(const std::filesystem::path& folder, SweepFile file,
                          const std::map<std::size_t, RunRecord>& unwritten = {});

/// Rows that differ only on the last axis (across) and the last but one (down).
struct SweepGrid {
  std::string title;                                     ///< values on the other axes; empty: this is the only grid
  const SweepAxis* down = nullptr;                       ///< null: a single row
  const SweepAxis* across = nullptr;                     ///< null: a single column
  std::vector<std::vector<const SweepRow*>> cells = {};  ///< rows by row and column of the grid; null: no such run
};

std::vector<SweepGrid> grids_of(const SweepResults& results);

/// Returns a row per run: number, varied keys, outcome and every figure.
std::string runs_csv(const SweepResults& results);

/// Returns the film grids for a report, with the microseconds and iterations of a step below each film.
std::string sweep_markdown(const SweepResults& results);

/// Returns LaTeX tables of the microseconds and iterations of a step, complete environments, see to_latex().
std::string sweep_latex(const SweepResults& results);

/// Returns a link from the sweep's folder to a run's film or sheet; empty if it has none.
std::string film_of(const SweepResults& results, const SweepRow& row);

/// Formats a figure for readers: "12.5"; a dash if there is none.
std::string short_figure(const SweepRow& row, const std::string& name);

}  // namespace drape
