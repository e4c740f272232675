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

/// Returns the frames of a comparison, up to the end of the longest motion.
FrameRange all_frames(const std::vector<Scene>& scenes, const CompareOptions& options);

/// The motions of a comparison, each at the times of the first scene's film. Each motion is simulated once, for any
/// number of passes, or read from its file. Frames beyond a memory limit are stored in temporary files.
class SynchronisedMotions {
 public:
  /// The current frame of each motion. A motion that has ended or diverged keeps its last frame.
  using Moment = std::vector<const Frame*>;

  /// @param scenes outlive the object
  /// @param often  true if the motions are played more than once, always from start to end
  SynchronisedMotions(const std::vector<Scene>& scenes, const CompareOptions& options, bool often);

  /// Plays all motions from the start; calls work(k, moment) for each frame k up to `last`. Ends early when stopped.
  void play(int last, const std::stop_token& stop, const std::function<void(int, const Moment&)>& work);

  /// Returns the i-th motion, as far as it was played.
  [[nodiscard]] const FrameSource& motion(std::size_t i) const { return sources_[i]; }

  /// Returns the first scene's camera for `count` frames, with all motions in view. A direction that the scene leaves
  /// open is that of its own film.
  /// @returns nothing if stopped before that is known
  std::optional<CameraPath> camera_path(int count, const std::stop_token& stop);

 private:
  const std::vector<Scene>& scenes_;
  int first_count_;  // frames of the first motion's film
  std::deque<FrameSource> sources_;
};

}  // namespace drape
