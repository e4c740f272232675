#pragma once

#include <exception>
#include <thread>

#include "run/bounded_queue.hpp"
#include "run/frame_source.hpp"

namespace drape {

/// Hands out the frames of a motion one by one, whoever asks for them, and has the next ones made meanwhile on a thread
/// of its own.
class FramePlayer {
 public:
  /// @param source outlives it, and is used by nobody else meanwhile
  explicit FramePlayer(FrameSource& source);
  ~FramePlayer();
  FramePlayer(const FramePlayer&) = delete;
  FramePlayer& operator=(const FramePlayer&) = delete;

  /// The next frame. When the motion is over, or diverges, its last one again and again.
  /// @throws Error whatever stops the motion otherwise
  const Frame& next();

 private:
  BoundedQueue<Frame> frames_{4};
  Frame now_;
  bool over_ = false;
  std::exception_ptr error_;
  std::jthread thread_;  // last: it uses all the others
};

}  // namespace drape
