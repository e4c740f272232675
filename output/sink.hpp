#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "render/image.hpp"
#include "sim/frame.hpp"

namespace drape {

/// A file that is complete.
struct OutputFile {
  std::filesystem::path path;
  std::uintmax_t size = 0;  ///< [bytes]
  std::string note = {};    ///< what is to be said of it: "412x343 pixels instead of 480x400"
};

/// Takes the frames of a film, one after the other, and makes files of them. A file appears under its name only when it
/// is complete, in place of an older one; a sink that is destroyed without finish() leaves nothing behind, but for the
/// files of a sequence, of which each is complete in itself. Use it from one thread at a time.
/// @tparam Item what flows: an Image, which was drawn, or a Frame, which needs no drawing
template <class Item>
class Sink {
 public:
  virtual ~Sink() = default;

  /// The next frame.
  /// @throws OutputError           if it cannot be stored
  /// @throws std::invalid_argument if it is an image of another size than the first one
  virtual void add(const Item& item) = 0;

  /// Returns whether it needs the film's frame with this number, where the first that is added has 0. One that it does
  /// not need may be skipped, unless it becomes the last because the film ends early.
  [[nodiscard]] virtual bool needs(int /*index*/) const { return true; }
  /// The next frame, which it does not need.
  virtual void skip() {}

  /// Completes the files with the frames added up to now. Call it once, as the last thing.
  /// @param ending  early: frames are missing, so that the film goes to its partial_name(); the files of a sequence
  /// keep
  ///                theirs
  /// @returns what was written: nothing if there was no frame
  /// @throws OutputError
  virtual std::vector<OutputFile> finish(Ending ending) = 0;
  std::vector<OutputFile> finish() { return finish(Ending::complete); }

  /// Which codec was found for it, where the machine decides: "H.264".
  [[nodiscard]] virtual std::string codec() const { return {}; }
};

using Encoder = Sink<Image>;       ///< of what was drawn
using MotionWriter = Sink<Frame>;  ///< of what nobody has to draw

}  // namespace drape
