#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "motion/reader.hpp"
#include "motion/writer.hpp"
#include "output/sink.hpp"
#include "run/bounded_queue.hpp"
#include "run/frame_source.hpp"
#include "run/statistics.hpp"

namespace drape {

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
