#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "drape/render/settings.hpp"
#include "drape/scene/scene.hpp"
#include "motion/reader.hpp"
#include "output/registry.hpp"
#include "run/frame_source.hpp"
#include "run/progress.hpp"
#include "run/records.hpp"
#include "run/statistics.hpp"

namespace drape {

/// The purposes of a run: outputs, motion file, records. Any thread may drop one that cannot be written.
class RunPurposes {
 public:
  RunPurposes(bool outputs, bool motion, bool records) : outputs_(outputs), motion_(motion), records_(records) {}

  /// @returns true if no purpose is left
  bool lose_outputs() { return lose(outputs_); }
  bool lose_motion() { return lose(motion_); }

  /// Returns true if no purpose is left.
  [[nodiscard]] bool none() const { return none_; }

 private:
  bool lose(std::atomic<bool>& reason) {
    reason = false;
    if (!outputs_ && !motion_ && !records_) none_ = true;
    return none_;
  }

  std::atomic<bool> outputs_, motion_, none_ = false;
  const bool records_;
};

/// Returns a Stop for a simulation that a stop request may end within a step.
Stop make_stop(const std::stop_token& stop);

/// Advances a simulation to step number `steps` and calls the observers in order. Returns early when a stop is
/// requested. A simulation with a Stop ends within the step, in the state before it.
/// @param from the checkpoint to resume from, if any
/// @throws DivergedError after the observers saw the last finite step
void run_steps(Simulation& simulation, std::int64_t steps, std::span<StepObserver* const> observers,
               const std::stop_token& stop, const ResumePoint* from = nullptr);

/// Advances likewise, with one function as the observer.
void run_steps(Simulation& simulation, std::int64_t steps, const std::stop_token& stop,
               const std::function<void(const StepReport&)>& after_step = {});

/// Checks that a checkpoint has every part that the simulation would have saved.
/// @throws UsageError if parts are missing
void require_whole(const ResumePoint& from, const Simulation& simulation);

/// Continues a state in a new simulation to step number `steps`. Ends early if that diverges.
void run_on(const SimulationSettings& settings, const State& state, std::int64_t steps,
            const std::vector<StepObserver*>& observers, const std::stop_token& stop);

/// Observer that shows the number of steps done.
class StepCounter final : public StepObserver {
 public:
  explicit StepCounter(Progress& progress) : progress_(progress) {}
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

 private:
  Progress& progress_;
};

/// Options of a run of a scene.
struct RunOptions {
  std::vector<std::string> outputs;         ///< films, frames and stills, see make_sink()
  std::optional<MotionOptions> motion;      ///< the motion file to write, if any
  std::shared_ptr<const ResumePoint> from;  ///< the checkpoint to resume from, of that motion file; null: the start
  std::shared_ptr<MotionReader> recorded;   ///< the motion file to draw, instead of simulating
  RecordPaths records;
  std::optional<std::int64_t> steps;      ///< instead of the scene's duration
  std::optional<FrameRange> frames;       ///< frames to draw; the simulation ends with the last of them
  std::optional<std::int64_t> every;      ///< steps per frame; absent: as the scene's video says
  std::optional<FileLimit> largest_file;  ///< size limit of a film, see SizeLimitedEncoder
  bool poster = false;                    ///< write a picture beside each film, see Poster
  std::optional<SheetGrid> sheet;         ///< frames in a picture whose path lacks {frame}; absent: the last
  GlBackend backend = GlBackend::automatic;
  int threads = 1;                   ///< threads for a step of a large cloth; 0: see with_threads()
  bool time_effects = false;         ///< measure each effect's share of the step time
  StepObserver* observer = nullptr;  ///< called after each step is recorded, on the simulating thread
  bool start_at_poster = false;      ///< begin looping films with their poster's frame
};

enum class Outcome { completed, interrupted, diverged };

/// Returns "completed", "interrupted" or "diverged".
inline const char* outcome_name(Outcome outcome) {
  return std::array{"completed", "interrupted", "diverged"}[static_cast<std::size_t>(outcome)];
}

/// The result of a run.
struct RunResult {
  Outcome outcome = Outcome::completed;
  std::string divergence;  ///< the message, if it diverged
  Statistics statistics;
  bool recorded = false;  ///< true if the motion was read from a file
  int frames = 0;         ///< written
  int frames_wanted = 0;  ///< 0: there are no outputs
  std::int64_t steps_wanted = 0;
  double draw_seconds = 0, write_seconds = 0, elapsed_seconds = 0;
  std::string renderer;                          ///< description of the renderer; empty if nothing was drawn
  std::vector<std::vector<OutputFile>> outputs;  ///< the files of each completed output
  std::optional<MotionOutcome> motion;           ///< absent if no motion file is written
  std::vector<std::string> records;              ///< names of the files
  std::vector<std::string> problems;             ///< a message for each output and record that could not be written
};

/// Returns the result of a run that was interrupted before its first step.
inline RunResult interrupted_at_once(std::int64_t steps_wanted) {
  RunResult result;
  result.outcome = Outcome::interrupted;
  result.steps_wanted = steps_wanted;
  return result;
}

/// Runs a scene. One thread simulates, one owns the OpenGL context and draws, if there is anything to draw, and one
/// writes. Bounded queues connect them; the calling thread only waits. After a divergence or a stop the outputs are
/// completed with the steps done so far, under names for incomplete results (see Ending). Without any step nothing is
/// written. A stop takes effect within steps and during setup, see Stop. A failed output or record does not stop the
/// others.
/// @throws Error from any of the threads, or if every output failed; no file is left then
RunResult run_scene(const LoadedScene& scene, const RunOptions& options, const std::stop_token& stop,
                    Progress& progress);

/// The disk space that a run's motion file will need, and the free space [bytes].
struct MotionSpace {
  double expected = 0, most = 0;  ///< additional to the existing file of a resumed run
  double free = 0;

  /// Returns a sentence with these figures.
  [[nodiscard]] std::string text(const std::string& file) const;
};

MotionSpace motion_space(const Scene& scene, const RunOptions& options);

/// Checks that a motion file can be written.
/// @param begun true if the run resumes this file
/// @throws UsageError  if another run left a file of this name, or the disk is expected to be too small
/// @throws OutputError if the file cannot be written
void require_motion_file(const MotionOptions& options, const MotionSpace& space, bool begun);

}  // namespace drape
