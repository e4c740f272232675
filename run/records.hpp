#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/files.hpp"
#include "drape/scene/scene.hpp"
#include "motion/reader.hpp"
#include "motion/writer.hpp"
#include "output/sink.hpp"
#include "run/bounded_queue.hpp"
#include "run/frame_source.hpp"
#include "run/statistics.hpp"

namespace drape {

/// Paths of a run's records; empty: not wanted.
struct RecordPaths {
  std::string stats;  ///< JSON, see Statistics::to_json
  std::string
      energies;  ///< CSV: step,time,total,kinetic,gravity,elastic, and of each of several cloths, from step 0 on [s, J]
  std::string positions;  ///< CSV: vertex,x,y,z after the last step, 17 digits [m]
  std::string trace;      ///< CSV: step,time,iterations,residual,step_us, from step 1 on [s, N, µs]
};

/// Writer of a run's records. The files get their names in finish(), whether or not the run succeeded; without that
/// call no file is left. A record that cannot be written stops neither the others nor the run.
class Records {
 public:
  /// Opens the files early, so that an unwritable folder is reported before the simulation starts.
  /// @throws OutputError if a file cannot be written
  explicit Records(const RecordPaths& paths);
  ~Records();

  /// Returns the observers that the wanted records need.
  [[nodiscard]] std::vector<StepObserver*> observers() const;

  /// Returns true if any record is wanted.
  [[nodiscard]] bool wanted() const;

  /// Completes every file, with a name that depends on `ending`, and returns the names.
  /// @param problems gets a message for each record that could not be written
  std::vector<std::string> finish(const Simulation& simulation, const Statistics& statistics,
                                  const std::string& outcome, Ending ending, std::vector<std::string>& problems);

 private:
  class Record;
  class EnergyLog;
  class TraceLog;

  std::unique_ptr<Record> stats_, positions_;
  std::unique_ptr<EnergyLog> energies_;
  std::unique_ptr<TraceLog> trace_;
};

/// Writes the records of a complete motion from its file. Only the last step is simulated again, for the error
/// estimates. A motion file has no step times: they are empty in the trace and null in the statistics.
/// @param scene of the motion
/// @returns the names of the files written
/// @throws UsageError  if the motion is damaged
/// @throws OutputError if a record cannot be written
std::vector<std::string> write_records(MotionReader& motion, const Scene& scene, const RecordPaths& paths);

/// Options of the motion file that a run writes.
struct MotionOptions {
  std::string path = {};  ///< may contain {scene}, see make_sink()
  RecordedSteps recorded = {};
  double checkpoint_seconds = 60;  ///< the most work lost if the process is killed [s]
};

/// The outcome of writing a motion file.
struct MotionOutcome {
  std::optional<OutputFile> complete;
  std::string growing;  ///< the incomplete file, from which a run can resume; empty if complete or given up
  std::string file;     ///< the name of the complete file
};

/// Observer that writes a run's motion file on a thread of its own. When resuming, it receives only new steps.
class MotionRecorder final : public StepObserver {
 public:
  /// @param from       the checkpoint to resume from; null: a new run
  /// @param extent     of the run
  /// @param statistics of the run, updated before this observer at each step
  /// @param given_up   called, from any thread, when the file cannot be written
  /// @throws UsageError, OutputError as MotionFileWriter
  MotionRecorder(const MotionOptions& options, const ResumePoint* from, const LoadedScene& scene,
                 const FilmExtent& extent, const Statistics& statistics, std::function<void()> given_up);
  ~MotionRecorder() override;

  void begin(const Simulation& simulation) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

  /// Waits until everything is written.
  /// @param whole true if the run reached its end; otherwise the file can be resumed
  /// @param last  the simulation, if it can be resumed
  /// @param problems gets a message if the file was given up
  MotionOutcome finish(bool whole, const Simulation* last, std::vector<std::string>& problems);

 private:
  using Task = std::function<void(MotionFileWriter&)>;

  void add(const Simulation& simulation, const StepReport& report);
  [[nodiscard]] bool is_recorded(std::int64_t step) const;
  void keep(const Simulation& simulation);
  void write();
  void discard_if_empty();

  MotionOptions options_;
  FilmExtent extent_;
  const Statistics& statistics_;
  std::function<void()> given_up_;
  MotionFileWriter writer_;
  std::chrono::steady_clock::time_point kept_;
  BoundedQueue<Task> tasks_;
  std::string problem_;  // written by the recorder's thread
  const bool begun_;     // true: the file already has the start
  bool finished_ = false;
  std::jthread thread_;
};

}  // namespace drape
