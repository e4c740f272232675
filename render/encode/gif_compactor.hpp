#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/encode/gif_palette.hpp"
#include "render/encode/libav.hpp"
#include "render/image.hpp"

namespace drape {

/// Changes pixels of a GIF's frames a little so that they compress better.
///
/// A GIF's frame is compressed by LZW (Welch 1984): a dictionary of the pixel sequences met so far, in which the
/// encoder looks for the longest one that fits. The compactor keeps the dictionary that the encoder will have, and
/// where no sequence goes on with the pixel's colour takes one that goes on with a colour near to it, as gifsicle's
/// --lossy does. How near depends on the surroundings: nobody sees in a weave what would be a streak on a glossy ball.
///
/// Two things it never does: change a pixel whose image has not changed since the frame before, which would flicker,
/// and change one of the palette's exact colours.
class GifCompactor {
 public:
  explicit GifCompactor(GifPalette palette);

  /// @param frame      palette indices, of the same size every time; changed in place
  /// @param source     the picture it was made from
  /// @param tolerance  the most a channel may be off where there is much contrast; 0 to change nothing
  void compact(AVFrame& frame, const Image& source, int tolerance);

 private:
  /// The dictionary of FFmpeg's GIF encoder: the entries 0…255 are the symbols, each other one extends an entry by a
  /// symbol; all but the symbols are forgotten when it is full.
  class Dictionary {
   public:
    Dictionary() { clear(); }
    void clear();
    void extend(int entry, int symbol);
    [[nodiscard]] int first_child(int entry) const { return first_child_[entry]; }
    [[nodiscard]] int next_sibling(int entry) const { return next_sibling_[entry]; }
    [[nodiscard]] int symbol(int entry) const { return symbol_[entry]; }

   private:
    static constexpr int capacity = 4096;
    std::array<std::int16_t, capacity> first_child_, next_sibling_;
    std::array<std::uint8_t, capacity> symbol_;
    int size_ = 0;
  };
  struct Box {
    int left, top, right, bottom;  // the last two are outside
  };

  Box keep_what_stays(AVFrame& frame, const Image& source) const;
  int choose(int entry, int wanted, std::size_t pixel, const std::uint8_t* color, int most_error) const;
  [[nodiscard]] bool is_fixed(std::size_t pixel, const Image& source) const;

  GifPalette palette_;
  int transparent_;
  Dictionary dictionary_;
  std::vector<std::uint8_t> shown_;  // indices of the frame before; empty before the first
  Image last_source_;
};

}  // namespace drape
