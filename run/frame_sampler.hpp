#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "render/settings.hpp"
#include "run/step_observer.hpp"
#include "sim/frame.hpp"

namespace drape {

/// A range of frame numbers, both ends included.
struct FrameRange {
  int first = 0;
  int last = 0;
  [[nodiscard]] int count() const { return last - first + 1; }
};

/// The times of a film's frames. Frame k shows time k·speed/fps [s] or the end of step k·n, from 0 to the motion's end.
struct FilmExtent {
  std::int64_t steps;                 ///< steps to simulate: up to the last frame
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
      : taker_(extent, std::move(receiver), contents) {}

  void begin(const Simulation& simulation) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

 private:
  void add(const Simulation& simulation, int iterations);

  FrameInterpolator taker_;
};

}  // namespace drape
