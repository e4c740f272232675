#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "output/frequent_colors.hpp"
#include "output/libav.hpp"
#include "render/image.hpp"

namespace drape {

/// The largest step in brightness (0…255) from a pixel to its four neighbours.
int local_contrast(const Image& image, int x, int y);

/// The colours of a GIF.
struct GifPalette {
  std::array<std::uint32_t, 256> colors{};  ///< 0xAARRGGBB: one is transparent, the others are opaque
  std::vector<std::uint32_t> exact;         ///< 0xRRGGBB, ascending: those in `colors` that no pixel may differ from
};

/// 0xRRGGBB of a pixel's three bytes.
inline std::uint32_t rgb_number(const std::uint8_t* pixel) {
  return static_cast<std::uint32_t>(pixel[0] << 16 | pixel[1] << 8 | pixel[2]);
}

/// Chooses the colours of a GIF from all frames of its film: FFmpeg's palettegen, which cuts the film's colours at the
/// median into boxes and takes the average of each (Heckbert 1982). An average hits no colour exactly, and a white
/// background that has become 254 shows on a white page. So the colours that cover a large part of the film then
/// replace the ones nearest to them.
class GifPaletteBuilder {
 public:
  GifPaletteBuilder(int width, int height);

  void add(const Image& image);

  /// Call it once, after the last frame.
  GifPalette finish();

 private:
  libav::FilterGraph graph_;
  FrequentColors frequent_;
};

/// Puts each of the palette's exact colours in the place of the opaque colour nearest to it.
void force_exact_colors(GifPalette& palette);

/// Turns an image into a frame for a palette without dithering: adds the 8×8 ordered pattern of Bayer (1973) to every
/// pixel whose colour is not in the palette. The pattern stays in place, so what does not move does not flicker, and
/// what has a colour of the palette keeps it.
class OrderedDither {
 public:
  explicit OrderedDither(const GifPalette& palette);

  [[nodiscard]] libav::Frame apply(const Image& image) const;

 private:
  std::vector<bool> in_palette_;  // 2²⁴, by 0xRRGGBB
  std::array<std::array<int, 8>, 8> offset_;
};

}  // namespace drape
