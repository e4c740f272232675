#pragma once

#include <cstdint>
#include <vector>

#include "core/spool.hpp"
#include "render/image.hpp"

namespace drape::gif {

/// Stores the frames of a film on disk, unchanged, to read them again. Holds one frame in memory.
class FrameSpool {
 public:
  /// @param output  destination of the film: the spool lies in its folder, and messages name it
  /// @throws OutputError
  explicit FrameSpool(const PartialFile& output);

  /// @throws OutputError           with the system's reason, such as a full disk
  /// @throws std::invalid_argument if the image has another size than the first one
  void append(const Image& image);

  [[nodiscard]] int count() const { return count_; }

  /// Returns to the first frame. No append() may follow.
  void rewind();

  /// Returns the next frame, valid until the next call. Call it at most count() times after rewind().
  const Image& next();

 private:
  Spool spool_;
  Image last_;                        // the frame that the next one is encoded relative to
  std::vector<std::uint8_t> packed_;  // encoded difference
  int count_ = 0;
};

}  // namespace drape::gif
