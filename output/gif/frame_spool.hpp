#pragma once

#include <cstdint>
#include <vector>

#include "core/spool.hpp"
#include "render/image.hpp"

namespace drape::gif {

/// Keeps the frames of a film on disk, unchanged, to go through them again. Holds one frame in memory.
class FrameSpool {
 public:
  /// @param output  what the frames are for: the spool lies in its folder, and messages name it
  /// @throws OutputError
  explicit FrameSpool(const PartialFile& output);

  /// @throws OutputError           naming the system's reason, a full disk above all
  /// @throws std::invalid_argument if the image has another size than the first one
  void append(const Image& image);

  [[nodiscard]] int count() const { return count_; }

  /// Goes back to the first frame. No frame can be appended after that.
  void rewind();

  /// The next frame, valid until the next call. Call it at most count() times after rewind().
  const Image& next();

 private:
  Spool spool_;
  Image last_;                        // the frame that the next one is stored as a difference to
  std::vector<std::uint8_t> packed_;  // that difference
  int count_ = 0;
};

}  // namespace drape::gif
