#pragma once

#include <exception>
#include <stop_token>
#include <thread>

#include "drape/scene/scene.hpp"
#include "motion/reader.hpp"
#include "run/bounded_queue.hpp"
#include "run/frame_source.hpp"

namespace drape {

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
