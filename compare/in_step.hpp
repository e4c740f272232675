#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "compare/compare_scenes.hpp"
#include "render/camera_path.hpp"
#include "run/frame_source.hpp"

namespace drape {

/// The frames of a comparison: until the last motion is over.
FrameRange all_frames(const std::vector<Scene>& scenes, const CompareOptions& options);

/// The motions of a comparison, each at the moments of the first scene's film. Each is computed once, however often
/// they are played, or read where it is in a file; they are never held in memory.
class MotionsInStep {
 public:
  /// By motion: its frame of a moment. A motion that is over, or has diverged, stays as it was last.
  using Moment = std::vector<const Frame*>;

  /// @param scenes outlive it
  /// @param often  whether they are played more than once, from their start to the end of all
  MotionsInStep(const std::vector<Scene>& scenes, const CompareOptions& options, bool often);

  /// Plays all of them from their start, and tells of every moment up to the last. Ends early when a stop is requested.
  void play(int last, const std::stop_token& stop, const std::function<void(int, const Moment&)>& work);

  /// The i-th, as far as it was played.
  [[nodiscard]] const FrameSource& motion(std::size_t i) const { return sources_[i]; }

  /// Where the first scene's camera is in each of so many frames: what its view must have in view are all motions, and
  /// a direction that it leaves open is the one that its own film would have.
  /// @returns nothing if a stop is requested before that is known
  std::optional<CameraPath> camera_path(int count, const std::stop_token& stop);

 private:
  const std::vector<Scene>& scenes_;
  int first_count_;  // frames of the first motion
  std::deque<FrameSource> sources_;
};

}  // namespace drape
