#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "core/files.hpp"
#include "drape/render/settings.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/state.hpp"
#include "motion/reader.hpp"
#include "run/bounded_queue.hpp"
#include "run/statistics.hpp"

namespace drape {

/// A range of frame numbers, both ends included.
struct FrameRange {
  int first = 0;
  int last = 0;
  [[nodiscard]] int count() const { return last - first + 1; }
};

/// The times of a film's frames. Frame k shows time k·speed/fps [s] or the end of step k·n, from 0 to the motion's end.
struct FilmExtent {
  std::int64_t steps;                 ///< steps to simulate: all, or up to the last of a range of frames
  double step;                        ///< step length h [s]
  std::optional<std::int64_t> every;  ///< n, if frames are counted in steps
  double seconds_per_frame;           ///< scene time from a frame to the next [s]
  FrameRange frames;                  ///< frames to draw

  /// @param frame_range absent: the whole motion
  /// @param every_steps steps per frame, at least 1; absent: the video's frame rate
  /// @throws UsageError if the motion has no such frames
  FilmExtent(const Video& video, double h, std::int64_t step_count, const std::optional<FrameRange>& frame_range,
             std::optional<std::int64_t> every_steps = {});

  /// Returns the time of a frame [s]; for the end of a step, exactly the step's own floating-point value.
  [[nodiscard]] double time(int frame) const {
    return every ? static_cast<double>(frame * *every) * step : frame * seconds_per_frame;
  }
};

/// The data in a film's frames: positions only, or also velocities and energies, which cost time to compute.
enum class FrameContents { places, motion };

/// The state of a motion at the end of a step, from which frames are made.
struct Moment {
  const State& state;
  int iterations;                                               ///< solver iterations of this step
  std::int64_t next;                                            ///< the step of the next moment
  std::function<Energies()> energies;                           ///< called only if a frame needs them
  std::function<std::vector<Collider>(double time)> colliders;  ///< colliders at a given time [s]
};

/// Interpolator of a film's frames, which hands out each frame of a range as soon as the motion has reached it.
/// Positions, velocities and energies are interpolated linearly between two moments.
class FrameInterpolator {
 public:
  using Receiver = std::function<void(Frame)>;

  FrameInterpolator(const FilmExtent& extent, Receiver receiver, FrameContents contents = FrameContents::places);

  /// Adds the next moment.
  void add(const Moment& moment);

  /// Returns true if all frames are made.
  [[nodiscard]] bool done() const { return next_ > extent_.frames.last; }

 private:
  [[nodiscard]] Frame frame(int index, const Moment& moment) const;
  /// Stores the data from which frames up to the next moment are interpolated.
  void keep(const Moment& moment);
  [[nodiscard]] double time_of(std::int64_t step) const { return static_cast<double>(step) * extent_.step; }

  FilmExtent extent_;
  Receiver receiver_;
  FrameContents contents_;
  int next_;
  State previous_;
  Energies previous_energies_;
};

/// Observer of a simulation that hands out its frames.
class FrameSampler final : public StepObserver {
 public:
  using Receiver = FrameInterpolator::Receiver;

  FrameSampler(const FilmExtent& extent, Receiver receiver, FrameContents contents = FrameContents::places)
      : interpolator_(extent, std::move(receiver), contents) {}

  void begin(const Simulation& simulation) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

 private:
  void add(const Simulation& simulation, int iterations);

  FrameInterpolator interpolator_;
};

/// A store of a film's frames for repeated passes. Frames beyond the memory limit go to an unnamed temporary file.
class FrameTape {
 public:
  static constexpr std::size_t usual_memory = std::size_t{256} << 20;  ///< [bytes]

  explicit FrameTape(std::size_t memory = usual_memory) : memory_(memory) {}

  /// Adds the next frame; not allowed after for_each() was called.
  /// @throws OutputError if the system's temporary folder is full
  void add(Frame frame);

  [[nodiscard]] int count() const { return static_cast<int>(frames_.size()); }

  /// Calls visit(frame) for each frame, in the order of addition. Returns early when a stop is requested.
  void for_each(const std::function<void(const Frame&)>& visit, const std::stop_token& stop = {});

 private:
  std::size_t memory_;
  std::vector<Frame> frames_;   // all frames; those in the file lack positions and velocities
  std::size_t in_memory_ = 0;   // number of frames with their data in memory
  std::optional<Spool> spool_;  // made for the first frame that does not fit
};

/// The frames of a motion, with all data that frames can hold, for any number of passes. The first pass simulates the
/// motion; a motion file is read again in each pass.
class FrameSource {
 public:
  /// @param scene    outlives the source
  /// @param recorded a reader of the motion file; null: the motion is simulated
  /// @param memory   for the frames of a simulation, see FrameTape; absent: a single pass
  FrameSource(const Scene& scene, std::shared_ptr<MotionReader> recorded, const FilmExtent& extent,
              std::optional<std::size_t> memory);

  /// Hands out every frame in order. Returns early when a stop is requested.
  /// @throws OutputError if the system's temporary folder is full
  void pass(const FrameInterpolator::Receiver& receiver, const std::stop_token& stop);

  /// Returns true once a pass has reached the end of the motion. Then statistics() has its steps (with times only if it
  /// was simulated), and divergence() the message if the motion diverged.
  [[nodiscard]] bool known() const { return known_; }
  [[nodiscard]] const Statistics& statistics() const { return statistics_; }
  [[nodiscard]] const std::string& divergence() const { return divergence_; }

 private:
  void simulate(const FrameInterpolator::Receiver& receiver, const std::stop_token& stop);
  void read(const FrameInterpolator::Receiver& receiver, const std::stop_token& stop);

  const Scene& scene_;
  std::shared_ptr<MotionReader> recorded_;
  FilmExtent extent_;
  std::optional<FrameTape> tape_;  // absent for a motion file or a single pass
  bool known_ = false;
  Statistics statistics_;
  std::string divergence_;
};

/// A reader of a motion's frames, one by one. A thread of its own makes the next frames ahead of time.
class FramePlayer {
 public:
  /// @param source outlives the player, which alone uses it
  explicit FramePlayer(FrameSource& source);
  ~FramePlayer();
  FramePlayer(const FramePlayer&) = delete;
  FramePlayer& operator=(const FramePlayer&) = delete;

  /// Returns the next frame; after the end or a divergence, the last frame again and again.
  /// @throws Error any other failure of the motion
  const Frame& next();

 private:
  BoundedQueue<Frame> frames_{4};
  Frame now_;
  bool over_ = false;
  std::exception_ptr error_;
  std::jthread thread_;  // last: it uses all members above
};

/// Hands out the frames of a motion file. They equal those of the simulation to the bit if the file stores the states
/// that they need. Returns early when a stop is requested.
/// @param scene of the motion, for its colliders
void sample_motion(MotionReader& motion, const Scene& scene, const FilmExtent& extent, FrameContents contents,
                   const FrameInterpolator::Receiver& receiver, const std::stop_token& stop);

/// Returns the number of frames that fall between states more than one step apart; a simulation would give others.
int frames_in_gaps(const MotionReader& motion, const FilmExtent& extent);

}  // namespace drape
