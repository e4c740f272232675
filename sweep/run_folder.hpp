#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace drape {

/// A sweep as Slurm jobs: an array of tasks, one per shard, and a final job that merges the shards.
struct SlurmJobs {
  std::string sweep;                 ///< shell command of the whole sweep, with its folder
  std::string program;               ///< path of the drape program on the nodes
  std::filesystem::path folder;      ///< folder of the sweep, shared by the nodes
  std::size_t tasks = 1;             ///< size of the array
  std::vector<std::string> options;  ///< sbatch options of both jobs: "--partition=short"
};

/// Writes sweep.sbatch, merge.sbatch and submit.sh, which submits both, into the folder. A requeued task resumes.
/// @returns submit.sh
/// @throws UsageError if the path of the current or the sweep's folder contains a line feed, because sbatch could read
/// options after it
/// @throws OutputError
std::filesystem::path write_slurm_jobs(const SlurmJobs& jobs);

enum class RunOutcome { completed, diverged, refused, failed, not_run };

/// Names of the outcomes in files and on pages, in order.
inline constexpr std::array run_outcome_names{"completed", "diverged", "refused", "failed", "not run"};

inline const char* name_of(RunOutcome outcome) { return run_outcome_names[static_cast<std::size_t>(outcome)]; }

/// The result of a run.
struct RunRecord {
  RunOutcome outcome = RunOutcome::not_run;
  std::string reason;              ///< reason for an incomplete run, as a sentence; empty if complete
  bool damaged = false;            ///< the record is unreadable, so the run counts as not run
  std::string timed;               ///< load of the machine as far as known: "alone", "beside 3 others"
  double seconds = 0;              ///< duration, with drawing and encoding
  std::vector<std::string> files;  ///< written files, in the run's folder
  std::vector<double> moments;     ///< times of the pictures in its contact sheet [s]
  std::vector<std::pair<std::string, std::string>> figures;  ///< figures from --stats: "step_us.median", "12.5"

  /// Returns true if the run need not be repeated, as its result would be the same.
  [[nodiscard]] bool settled() const { return outcome == RunOutcome::completed || outcome == RunOutcome::diverged; }
  /// Returns the figure of this name; empty if there is none.
  [[nodiscard]] std::string figure(const std::string& name) const;
};

/// Returns the folder of a run.
std::filesystem::path run_place(const std::filesystem::path& sweep, const std::string& key);

/// Reads the record of a run, if there is one. A damaged record, or one of another run, gives RunOutcome::not_run with
/// the reason.
/// @throws UsageError if the record names a file outside the run's folder
std::optional<RunRecord> read_run(const std::filesystem::path& sweep, const std::string& key);

/// The folder of a run, hidden until the run is complete. The destructor removes an incomplete folder. The next sweep
/// removes folders of killed processes, see remove_unfinished().
class RunFolder {
 public:
  /// @throws OutputError
  RunFolder(const std::filesystem::path& sweep, const std::string& key);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  /// Returns the folder to write into.
  [[nodiscard]] const std::filesystem::path& place() const { return hidden_; }

  /// Removes all files written so far.
  void clear();

  /// Writes the record and stats.json, and renames the folder to its final name, replacing an older one. The two files
  /// are not flushed to disk, because flushing takes longer than many runs. A run damaged by a power cut is repeated.
  /// @param stats of the run, as JSON; empty: no step was done
  /// @throws OutputError
  void commit(const RunRecord& record, const std::string& stats);

 private:
  std::string key_;
  std::filesystem::path place_, hidden_;
};

/// Removes incomplete run folders of killed processes.
void remove_unfinished(const std::filesystem::path& sweep);

}  // namespace drape
