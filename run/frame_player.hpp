#pragma once

#include <exception>
#include <thread>

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

}  // namespace drape
