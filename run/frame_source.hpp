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

/// The frames of a motion, with all that frames can hold, to go through as often as they are wanted: the motion is
/// simulated the first time only, or is read each time where it is in a file.
class FrameSource {
 public:
  /// @param scene    outlives it
  /// @param recorded its motion, if that is in a file; null: it is simulated
  /// @param memory   for the frames of a simulation, see FrameTape; absent: they are gone through once
  FrameSource(const Scene& scene, std::shared_ptr<MotionReader> recorded, const FilmExtent& extent,
              std::optional<std::size_t> memory);

  /// Hands out every frame, in their order. Returns early when a stop is requested.
  /// @throws OutputError if the system's folder for temporary files takes no more
  void pass(const FrameTaker::Receiver& receiver, const std::stop_token& stop);

  /// Whether the motion is known to its end, because all of it was gone through; of it, how the steps went (their times
  /// only where it was simulated), and why it diverged, if it did.
  [[nodiscard]] bool known() const { return known_; }
  [[nodiscard]] const Statistics& statistics() const { return statistics_; }
  [[nodiscard]] const std::string& divergence() const { return divergence_; }

 private:
  void simulate(const FrameTaker::Receiver& receiver, const std::stop_token& stop);
  void read(const FrameTaker::Receiver& receiver, const std::stop_token& stop);

  const Scene& scene_;
  std::shared_ptr<MotionReader> recorded_;
  FilmExtent extent_;
  std::optional<FrameTape> tape_;  // unless it is read, or gone through once
  bool known_ = false;
  Statistics statistics_;
  std::string divergence_;
};

}  // namespace drape
