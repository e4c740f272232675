#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "output/format.hpp"
#include "render/backend.hpp"
#include "run/frame_sampler.hpp"
#include "run/motion_recorder.hpp"
#include "run/progress.hpp"
#include "run/records.hpp"
#include "run/statistics.hpp"
#include "scene/scene.hpp"

namespace drape {

/// What a run of a scene should do.
struct RunOptions {
  std::vector<std::string> outputs;        ///< films, frames and stills, see make_sink()
  std::optional<MotionOptions> motion;     ///< a motion file that is written, too
  std::shared_ptr<const Resumption> from;  ///< where the run goes on from, whose motion file that is; null: the start
  std::shared_ptr<MotionReader> recorded;  ///< the motion, which is not simulated then: what there is, is drawn
  RecordPaths records;
  std::optional<std::int64_t> steps;      ///< instead of the scene's duration
  std::optional<FrameRange> frames;       ///< draw only these, and simulate no further than they need
  std::optional<std::int64_t> every;      ///< steps from a frame to the next; absent: as the scene's video says
  std::optional<FileLimit> largest_file;  ///< that a film may become, see FittedFilm
  bool poster = false;                    ///< put a picture beside each film, see Poster
  std::optional<SheetGrid> sheet;         ///< what a picture without {frame} in its path shows instead of the last
  GlBackend backend = GlBackend::automatic;
  int threads = 1;                   ///< that share a step of a large cloth; 0: see with_threads()
  std::function<void()> drawn = {};  ///< called when every frame is with its outputs, which are only completed then
  bool time_effects = false;         ///< measure which part of the steps' time each effect takes
  StepObserver* observer = nullptr;  ///< told of every step too, on the thread that simulates, after it is recorded
  bool start_at_poster = false;      ///< begin films that repeat for ever with the frame of their poster
};

enum class Outcome { completed, interrupted, diverged };

/// "completed", "interrupted" or "diverged".
inline const char* outcome_name(Outcome outcome) {
  return std::array{"completed", "interrupted", "diverged"}[static_cast<std::size_t>(outcome)];
}

/// What a run did.
struct RunResult {
  Outcome outcome = Outcome::completed;
  std::string divergence;  ///< the message, if it diverged
  Statistics statistics;
  bool recorded = false;  ///< whether the motion was read from a file
  int frames = 0;         ///< that were written
  int frames_wanted = 0;  ///< 0: there are no outputs
  std::int64_t steps_wanted = 0;
  double draw_seconds = 0, write_seconds = 0, elapsed_seconds = 0;
  std::string renderer;                          ///< what drew; empty if nothing was
  std::vector<std::vector<OutputFile>> outputs;  ///< the files of each output that there is
  std::optional<MotionOutcome> motion;           ///< where a motion file is written
  std::vector<std::string> records;              ///< likewise
  std::vector<std::string> problems;             ///< a message for each output and record that could not be written
};

/// Of a run that was interrupted before it could begin.
inline RunResult interrupted_at_once(std::int64_t steps_wanted) {
  RunResult result;
  result.outcome = Outcome::interrupted;
  result.steps_wanted = steps_wanted;
  return result;
}

/// Runs a scene: one thread simulates, one owns the GL context and draws, if anything is to be drawn, and one writes,
/// with bounded queues between them; the calling thread only waits. When the motion diverges or a stop is requested,
/// what was done so far is completed, under names that say that it is not all (see Ending): nothing if there was no
/// step yet. A stop is looked at within steps and while the simulation is set up, see Stop. An output or a record that
/// cannot be written does not keep the others from being completed.
/// @throws Error whatever stopped one of the threads, or that there is nothing left to run for; no file is left then
RunResult run_scene(const Scene& scene, const RunOptions& options, const std::stop_token& stop, Progress& progress);

}  // namespace drape
