#pragma once

#include <exception>
#include <optional>
#include <string>
#include <thread>

#include "run/bounded_queue.hpp"
#include "run/frame_sampler.hpp"
#include "run/statistics.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Hands out the frames of a motion one by one, whoever asks for them, and computes the next ones meanwhile on a thread
/// of its own.
class FramePlayer {
 public:
  /// @param scene outlives it
  FramePlayer(const Scene& scene, const FilmExtent& extent, FrameContents contents);
  ~FramePlayer();
  FramePlayer(const FramePlayer&) = delete;
  FramePlayer& operator=(const FramePlayer&) = delete;

  /// The next frame. When the motion is over, or diverges, its last one again and again.
  /// @throws Error whatever stops the motion otherwise
  const Frame& next();

  /// What next() returned last.
  [[nodiscard]] const Frame& now() const { return now_; }
  /// Whether that is no frame of its own any more.
  [[nodiscard]] bool over() const { return over_; }
  /// How the steps went, and why the motion diverged, if it did: once it is over.
  [[nodiscard]] const Statistics& statistics() const { return statistics_; }
  [[nodiscard]] const std::string& divergence() const { return divergence_; }

 private:
  void play(const Scene& scene, const FilmExtent& extent, FrameContents contents, const std::stop_token& stop);

  BoundedQueue<Frame> frames_{4};
  Frame now_;
  bool over_ = false;
  Statistics statistics_;
  std::string divergence_;
  std::exception_ptr error_;
  std::jthread thread_;  // last: it uses all the others
};

}  // namespace drape
