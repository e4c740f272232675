#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/spool.hpp"
#include "sim/frame.hpp"

namespace drape {

/// A store of a film's frames for repeated passes. Frames beyond the memory limit go to an unnamed temporary file.
class FrameTape {
 public:
  static constexpr std::size_t usual_memory = std::size_t{256} << 20;  ///< [bytes]

  explicit FrameTape(std::size_t memory = usual_memory) : memory_(memory) {}

  /// Adds the next frame; not allowed after for_each() was called.
  /// @throws OutputError if the system's temporary folder is full
  void add(Frame frame);

  [[nodiscard]] int count() const { return static_cast<int>(frames_.size()); }

  /// Calls visit(frame) for each frame, in the order of addition. Returns early when a stop is requested.
  void for_each(const std::function<void(const Frame&)>& visit, const std::stop_token& stop = {});

 private:
  std::size_t memory_;
  std::vector<Frame> frames_;   // all frames; those in the file lack positions and velocities
  std::size_t in_memory_ = 0;   // number of frames with their data in memory
  std::optional<Spool> spool_;  // made for the first frame that does not fit
};

}  // namespace drape
