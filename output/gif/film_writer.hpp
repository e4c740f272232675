#pragma once

#include <cstdint>

#include "core/files.hpp"
#include "drape/render/image.hpp"
#include "output/gif/compactor.hpp"
#include "output/gif/dither.hpp"
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

/// Writes the frames of a film to a GIF.
///
/// The target is 0.14 bytes per pixel and frame: 5.6 MB for 209 frames of 480×400. The further a film exceeds it, the
/// more tolerance the Compactor gets; a smaller film stays lossless.
class FilmWriter {
 public:
  /// @param file  must outlive this object
  /// @throws OutputError
  FilmWriter(PartialFile& file, int width, int height, const Palette& palette);

  /// @param duration  time on screen [1/100 s]
  void add(const Image& image, std::int64_t duration);

  /// Completes the file.
  void finish() { container_.finish(); }

 private:
  [[nodiscard]] int tolerance() const;

  OrderedDither dither_;
  Compactor compactor_;
  Container container_;
  double bytes_per_frame_;  // target
  double debt_ = 0;         // bytes of the frames so far above the target; negative: saved
};

}  // namespace drape::gif
