#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "output/gif/indexed_frame.hpp"
#include "output/gif/lzw.hpp"
#include "output/gif/palette.hpp"

namespace drape::gif {

/// What a frame changes of the one before.
struct Patch {
  int x = 0, y = 0, width = 1, height = 1;  ///< the rectangle that it lies in; never empty, as that of a GIF
  std::string data;                         ///< its pixels, compressed
};

/// Compresses a film's frames as a GIF does. Of each only the rectangle that has changed is kept, and within it the
/// pixels that have not are transparent. Beyond a tolerance of 0 it changes pixels a little so that they take fewer
/// bytes.
///
/// LZW looks for the longest sequence of its dictionary that goes on with the next pixels. Where none does with a
/// pixel's colour, the compactor takes one that goes on with a colour near to it, as gifsicle's --lossy does. How near
/// depends on the surroundings: nobody sees in a weave what would be a streak on a glossy ball.
///
/// Three things it never does: change a pixel where nothing has changed since the frame before, which would flicker;
/// change one of the palette's exact colours; leave a pixel, for more than one frame, farther from its colour than the
/// dither may be: cloth that has passed would leave its traces behind.
class Compactor {
 public:
  Compactor(const Palette& palette, int width, int height);

  /// @param tolerance  how far a colour may be off where there is much contrast: the root of the weighted mean square
  ///                   of its channels, in steps of 1/255; 0 to change nothing
  Patch compact(const IndexedFrame& frame, int tolerance);

 private:
  /// What is to be compressed of one pixel.
  struct Pixel {
    std::uint8_t symbol;       // what it is if nothing is changed: an index, or the transparent one
    std::uint8_t shown;        // its index in the frame before; the transparent one in the first frame
    std::uint16_t most_error;  // that is allowed
    std::uint32_t source;
  };

  /// A way through the dictionary that pixels can take.
  struct Match {
    int entry = 0;
    int length = 0;
    int error = 0;
  };

  [[nodiscard]] Patch changed(const IndexedFrame& frame) const;
  [[nodiscard]] Pixel pixel(const IndexedFrame& frame, std::size_t i, int tolerance) const;
  [[nodiscard]] bool is_exact(std::uint32_t color) const;
  [[nodiscard]] bool may_stay(const IndexedFrame& frame, std::size_t i) const;
  [[nodiscard]] int lasting_error(const IndexedFrame& frame, std::size_t i) const;
  [[nodiscard]] int most_error(const IndexedFrame& frame, std::size_t i, int tolerance) const;
  std::string compress();
  [[nodiscard]] int error(const Pixel& pixel, int symbol) const;
  void find_longest(std::span<const Pixel> pixels, const Match& match, Match& best) const;

  Palette palette_;
  int height_;
  std::vector<std::uint8_t> shown_;  // indices of the frame before
  std::vector<Span> touched_;        // by row, in the frame before
  std::vector<std::uint8_t> late_;   // 1: farther off in the frame before than it may stay
  LzwDictionary dictionary_;
  std::vector<Pixel> pixels_;  // of the patch
};

}  // namespace drape::gif
