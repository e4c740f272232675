#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/spool.hpp"
#include "sim/frame.hpp"

namespace drape {

/// Keeps the frames of a film to go through them again. What does not fit into so much memory lies in a file without a
/// name.
class FrameTape {
 public:
  static constexpr std::size_t usual_memory = std::size_t{256} << 20;  ///< [bytes]

  explicit FrameTape(std::size_t memory = usual_memory) : memory_(memory) {}

  /// The next frame. None can be added once the tape was gone through.
  /// @throws OutputError if the system's folder for temporary files takes no more
  void add(Frame frame);

  [[nodiscard]] int count() const { return static_cast<int>(frames_.size()); }

  /// Calls visit(frame) for each frame, in their order, as it was added. Returns early when a stop is requested.
  void for_each(const std::function<void(const Frame&)>& visit, const std::stop_token& stop = {});

 private:
  std::size_t memory_;
  std::vector<Frame> frames_;   // without positions and velocities where they lie in the file
  std::size_t in_memory_ = 0;   // how many of them have theirs
  std::optional<Spool> spool_;  // made when a frame does not fit
};

}  // namespace drape
