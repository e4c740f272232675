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

/// The cloth at a time within the simulation's last step: linear between where it was before and where it is now, and
/// at the step's end exactly that, with the step's own bits.
/// @param before n×3 [m]
Vertices positions_at(double time, const Simulation& simulation, const Vertices& before);

/// Watches a simulation and hands out the frames of a range as soon as the motion reaches them. A frame between two
/// steps is interpolated linearly between them, its velocities and energies too.
class FrameSampler final : public StepObserver {
 public:
  using Receiver = std::function<void(Frame)>;

  FrameSampler(const FilmExtent& extent, Receiver receiver, FrameContents contents = FrameContents::places);

  void begin(const Simulation& simulation) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

 private:
  void emit_until(const Simulation& simulation);
  [[nodiscard]] Frame frame(int index, const Simulation& simulation) const;
  /// Keeps what frames within the next step are interpolated from.
  void keep(const Simulation& simulation);

  FilmExtent extent_;
  Receiver receiver_;
  FrameContents contents_;
  int next_;
  int iterations_ = 0;  // of the last step
  Vertices previous_, previous_velocities_;
  Energies previous_energies_;
};

}  // namespace drape
