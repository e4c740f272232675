#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "output/gif_palette.hpp"
#include "output/libav.hpp"
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
  /// @param tolerance  how far a colour may be off where there is much contrast: the root of the weighted mean square
  ///                   of its channels, in steps of 1/255; 0 to change nothing
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
    [[nodiscard]] int parent(int entry) const { return parent_[entry]; }
    [[nodiscard]] int symbol(int entry) const { return symbol_[entry]; }

   private:
    static constexpr int capacity = 4096;
    std::array<std::int16_t, capacity> first_child_, next_sibling_, parent_;
    std::array<std::uint8_t, capacity> symbol_;
    int size_ = 0;
  };

  /// What to compress of one pixel.
  struct Pixel {
    std::uint8_t* index;        // in the frame
    const std::uint8_t* color;  // wanted
    int shown;                  // its index in the frame before; -1 in the first frame
    int most_error;             // that is allowed

    /// What the encoder writes for an index: where nothing changes, the transparent one.
    [[nodiscard]] int symbol(int transparent) const { return *index == shown ? transparent : *index; }
  };

  /// A way through the dictionary that pixels can take.
  struct Match {
    int entry = 0;
    int length = 0;
    std::int64_t error = 0;
  };

  std::vector<Pixel> changed_pixels(AVFrame& frame, const Image& source, int tolerance);
  [[nodiscard]] bool is_exact(const std::uint8_t* color) const;
  [[nodiscard]] int error(const Pixel& pixel, int symbol) const;
  void find_longest(std::span<const Pixel> pixels, const Match& match, Match& best) const;

  GifPalette palette_;
  int transparent_;
  Dictionary dictionary_;
  std::vector<std::uint8_t> shown_;  // indices of the frame before; empty before the first
  Image last_source_;
};

}  // namespace drape
