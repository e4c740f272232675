#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "render/image.hpp"
#include "sim/frame.hpp"

namespace drape {

/// A complete file.
struct OutputFile {
  std::filesystem::path path;
  std::uintmax_t size = 0;  ///< [bytes]
  std::string note = {};    ///< remark for the user: "412x343 pixels instead of 480x400"
};

/// Receives the frames of a film in order and writes files. A file appears under its name only when it is complete, and
/// replaces an older one. A sink destroyed without finish() leaves nothing behind but the complete files of a sequence.
/// Use it from one thread at a time.
/// @tparam Item kind of frame: an Image, which was drawn, or a Frame, which needs no drawing
template <class Item>
class Sink {
 public:
  virtual ~Sink() = default;

  /// Adds the next frame.
  /// @throws OutputError           if it cannot be stored
  /// @throws std::invalid_argument if it is an image of another size than the first one
  virtual void add(const Item& item) = 0;

  /// Returns true if it needs the film's frame with this index, counted from the first added frame. Other frames may be
  /// skipped, unless they become the last because the film ends early.
  [[nodiscard]] virtual bool needs(int /*index*/) const { return true; }
  /// Skips the next frame, which is not needed.
  virtual void skip() {}

  /// Completes the files with all frames added so far. Call it once, at the end.
  /// @param ending  early: frames are missing, so the film gets its partial_name(); files of a sequence keep their
  ///                names
  /// @returns the written files; none without a frame
  /// @throws OutputError
  virtual std::vector<OutputFile> finish(Ending ending) = 0;
  std::vector<OutputFile> finish() { return finish(Ending::complete); }

  /// Returns the codec that was chosen on this machine: "H.264".
  [[nodiscard]] virtual std::string codec() const { return {}; }
};

using Encoder = Sink<Image>;       ///< takes drawn images
using MotionWriter = Sink<Frame>;  ///< needs no rendering

}  // namespace drape
