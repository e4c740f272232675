#pragma once

#include <cstdint>

#include "core/atomic_file.hpp"
#include "output/gif/compactor.hpp"
#include "output/gif/palette.hpp"

namespace drape::gif {

/// Writes the blocks of an animated GIF that repeats for ever (Graphics Interchange Format, version 89a, CompuServe
/// 1990), with one colour table for all frames, each of which is drawn over the previous one.
class Container {
 public:
  /// @param file  must outlive this object
  /// @throws OutputError
  Container(PartialFile& file, int width, int height, const Palette& palette);

  /// Appends a frame. @param duration  of the frame [1/100 s]
  /// @returns its size [bytes]
  std::size_t add(const Patch& patch, std::int64_t duration);

  /// Ends the file.
  void finish();

 private:
  PartialFile& file_;
};

}  // namespace drape::gif
