#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "output/gif/indexed_frame.hpp"
#include "output/gif/lzw.hpp"
#include "output/gif/palette.hpp"

namespace drape::gif {

/// The changes of a frame relative to the previous one.
struct Patch {
  int x = 0, y = 0, width = 1, height = 1;  ///< bounding rectangle; never empty, as GIF requires
  std::string data;                         ///< compressed pixels
};

/// Compresses a film's frames for GIF. Each frame stores only the rectangle that has changed, in which unchanged pixels
/// are transparent. With a tolerance above 0 it changes pixels slightly to save bytes.
///
/// LZW searches its dictionary for the longest sequence that matches the next pixels. If none continues with a pixel's
/// colour, the compactor accepts a similar colour, as gifsicle's --lossy does. The allowed error depends on the
/// surroundings: it is invisible in a weave where it would show as a streak on a glossy ball.
///
/// Three rules always hold. Pixels unchanged since the previous frame stay, because changes would flicker. Exact
/// colours of the palette stay. No pixel is wrong by more than the dither's error for longer than one frame, because
/// passing cloth would leave traces.
class Compactor {
 public:
  Compactor(const Palette& palette, int width, int height);

  /// @param tolerance  greatest colour error in areas of high contrast: weighted root mean square of the channels, in
  ///                   steps of 1/255; 0: lossless
  Patch compact(const IndexedFrame& frame, int tolerance);

 private:
  /// Data for compressing one pixel.
  struct Pixel {
    std::uint8_t symbol;       // lossless symbol: an index, or the transparent one
    std::uint8_t shown;        // index in the previous frame; the transparent one in the first frame
    std::uint16_t most_error;  // greatest allowed error
    std::uint32_t source;
  };

  /// A path through the dictionary that matches pixels.
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
  std::vector<std::uint8_t> shown_;  // indices of the previous frame
  std::vector<Span> touched_;        // per row, in the previous frame
  std::vector<std::uint8_t> late_;   // 1: the error in the previous frame must not last
  LzwDictionary dictionary_;
  std::vector<Pixel> pixels_;  // of the patch
};

}  // namespace drape::gif
