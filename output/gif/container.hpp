#pragma once

#include <cstdint>

#include "core/atomic_file.hpp"
#include "output/gif/compactor.hpp"
#include "output/gif/palette.hpp"

namespace drape::gif {

/// Writes the blocks of an animated GIF that repeats for ever (Graphics Interchange Format, version 89a, CompuServe
/// 1990): one table of colours for all frames, each of which is laid over the one before.
class Container {
 public:
  /// @param file  has to outlive it
  /// @throws OutputError
  Container(PartialFile& file, int width, int height, const Palette& palette);

  /// @param duration  of the frame [1/100 s]
  /// @returns how many bytes it took
  std::size_t add(const Patch& patch, std::int64_t duration);

  /// Ends the file.
  void finish();

 private:
  PartialFile& file_;
};

}  // namespace drape::gif
