#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "motion/checkpoint.hpp"
#include "motion/writer.hpp"
#include "output/sink.hpp"
#include "run/bounded_queue.hpp"
#include "run/frame_sampler.hpp"
#include "run/statistics.hpp"

namespace drape {

/// A motion file that a run writes.
struct MotionOptions {
  std::string path = {};  ///< may have {scene}, see make_sink()
  RecordedSteps recorded = {};
  double checkpoint_seconds = 60;  ///< of work that are lost at most when the process is killed
};

/// Of a motion file, what has become of it.
struct MotionOutcome {
  std::optional<OutputFile> complete;
  std::string growing;  ///< where what there is of it can be gone on with; empty where it is complete or was given up
  std::string file;     ///< its name when it is complete
};

/// Watches a run and writes its motion file, on a thread of its own. Of a run that is gone on with it is told the rest.
class MotionRecorder final : public StepObserver {
 public:
  /// @param from       where the run goes on from; null: it begins
  /// @param extent     of the run
  /// @param statistics of the run, which are told of a step before this is
  /// @param given_up   called, from any thread, when the file cannot be written
  /// @throws UsageError, OutputError as MotionFileWriter
  MotionRecorder(const MotionOptions& options, const Resumption* from, const Scene& scene, const FilmExtent& extent,
                 const Statistics& statistics, std::function<void()> given_up);
  ~MotionRecorder() override;

  void begin(const Simulation& simulation) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

  /// Waits until all is written.
  /// @param whole whether the run came to its end; otherwise what there is can be gone on with
  /// @param last  the simulation, where it can be gone on from
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
  std::string problem_;  // written by the thread
  const bool begun_;     // the file has the start already
  bool finished_ = false;
  std::jthread thread_;
};

}  // namespace drape
