#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "motion/reader.hpp"
#include "run/frame_sampler.hpp"
#include "run/frame_tape.hpp"
#include "run/statistics.hpp"
#include "scene/scene.hpp"

namespace drape {

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

}  // namespace drape
