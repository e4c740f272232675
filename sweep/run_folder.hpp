#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace drape {

enum class RunOutcome { completed, diverged, refused, failed, not_run };

/// What they are called in files and on pages, in their order.
inline constexpr std::array run_outcome_names{"completed", "diverged", "refused", "failed", "not run"};

inline const char* name_of(RunOutcome outcome) { return run_outcome_names[static_cast<std::size_t>(outcome)]; }

/// What became of a run.
struct RunRecord {
  RunOutcome outcome = RunOutcome::not_run;
  std::string reason;              ///< why it is not complete, a sentence; empty: it is
  bool damaged = false;            ///< its file cannot be read, so that it counts as not run
  std::string timed;               ///< what else ran beside it, as far as its sweep knows: "alone", "beside 3 others"
  double seconds = 0;              ///< that it took, with drawing and encoding
  std::vector<std::string> files;  ///< in its folder, that it wrote
  std::vector<double> moments;     ///< of the motion that its contact sheet shows [s]
  std::vector<std::pair<std::string, std::string>> figures;  ///< of its --stats: "step_us.median", "12.5"

  /// Whether it need not be run again: it would end in the same way.
  [[nodiscard]] bool settled() const { return outcome == RunOutcome::completed || outcome == RunOutcome::diverged; }
  /// The figure of this name; empty: it has none.
  [[nodiscard]] std::string figure(const std::string& name) const;
};

/// Where a run's folder is.
std::filesystem::path run_place(const std::filesystem::path& sweep, const std::string& key);

/// Reads the record of a run; nothing if there is none. A record that is damaged, or of another run, reads as that of a
/// run that was not run, with the reason.
/// @throws UsageError if it names a file that is not in the folder
std::optional<RunRecord> read_run(const std::filesystem::path& sweep, const std::string& key);

/// The folder of a run, which appears under its name only when the run is complete. Until then it is hidden, and gone
/// with this object; one of a process that was killed is removed by the next sweep, see remove_unfinished().
class RunFolder {
 public:
  /// @throws OutputError
  RunFolder(const std::filesystem::path& sweep, const std::string& key);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  /// Where to write.
  [[nodiscard]] const std::filesystem::path& place() const { return hidden_; }

  /// Removes what was written so far.
  void clear();

  /// Adds what became of the run and its stats.json, and gives the folder its name, in place of what has it. These two
  /// are not forced onto the disk, which would take longer than many a run: one that a power cut has damaged is run
  /// again.
  /// @param stats of the run, as JSON; empty: it took no step
  /// @throws OutputError
  void commit(const RunRecord& record, const std::string& stats);

 private:
  std::string key_;
  std::filesystem::path place_, hidden_;
};

/// Removes what killed processes left of runs.
void remove_unfinished(const std::filesystem::path& sweep);

}  // namespace drape
