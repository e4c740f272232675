#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "render/settings.hpp"
#include "run/step_observer.hpp"
#include "sim/frame.hpp"

namespace drape {

/// Frame numbers, both ends included.
struct FrameRange {
  int first = 0;
  int last = 0;
  [[nodiscard]] int count() const { return last - first + 1; }
};

/// Which moments of a motion a film shows: frame k is taken at k·speed/fps seconds, or else after k·n steps, from 0 to
/// the end of the motion.
struct FilmExtent {
  std::int64_t steps;                 ///< that are simulated: no more than the last frame needs
  double step;                        ///< h [s]
  std::optional<std::int64_t> every;  ///< n, where frames are counted in steps
  double seconds_per_frame;           ///< of the scene's time
  FrameRange frames;                  ///< that are drawn

  /// @param frame_range absent: the whole motion
  /// @param every_steps from a frame to the next, at least 1; absent: as the video says
  /// @throws UsageError if the motion has no such frames
  FilmExtent(const Video& video, double h, std::int64_t step_count, const std::optional<FrameRange>& frame_range,
             std::optional<std::int64_t> every_steps = {});

  /// Of a frame that is a step's end, with that step's own bits.
  [[nodiscard]] double time(int frame) const {
    return every ? static_cast<double>(frame * *every) * step : frame * seconds_per_frame;
  }
};

/// What a film's frames hold: where everything is, or also how the cloth moves, which takes time to find out.
enum class FrameContents { places, motion };

/// What frames are made of: where a motion is at the end of a step.
struct Moment {
  const State& state;
  int iterations;                                               ///< of the step
  std::int64_t next;                                            ///< the step of the moment after this
  std::function<Energies()> energies;                           ///< called if they are needed
  std::function<std::vector<Collider>(double time)> colliders;  ///< at any time
};

/// Hands out the frames of a range as soon as a motion has reached them. A frame between two moments is interpolated
/// linearly between them, its velocities and energies too.
class FrameTaker {
 public:
  using Receiver = std::function<void(Frame)>;

  FrameTaker(const FilmExtent& extent, Receiver receiver, FrameContents contents = FrameContents::places);

  /// The next moment.
  void add(const Moment& moment);

  /// Whether all frames are made.
  [[nodiscard]] bool done() const { return next_ > extent_.frames.last; }

 private:
  [[nodiscard]] Frame frame(int index, const Moment& moment) const;
  /// Keeps what frames up to the next moment are interpolated from.
  void keep(const Moment& moment);
  [[nodiscard]] double time_of(std::int64_t step) const { return static_cast<double>(step) * extent_.step; }

  FilmExtent extent_;
  Receiver receiver_;
  FrameContents contents_;
  int next_;
  State previous_;
  Energies previous_energies_;
};

/// Watches a simulation and hands out its frames.
class FrameSampler final : public StepObserver {
 public:
  using Receiver = FrameTaker::Receiver;

  FrameSampler(const FilmExtent& extent, Receiver receiver, FrameContents contents = FrameContents::places)
      : taker_(extent, std::move(receiver), contents) {}

  void begin(const Simulation& simulation) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

 private:
  void add(const Simulation& simulation, int iterations);

  FrameTaker taker_;
};

}  // namespace drape
