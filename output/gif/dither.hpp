#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "drape/render/image.hpp"
#include "output/gif/palette.hpp"

namespace drape::gif {

/// Pixels [begin, end) of a row; empty if begin ≥ end.
struct Span {
  int begin = 1 << 30, end = 0;

  [[nodiscard]] bool empty() const { return begin >= end; }
  void include(const Span& other) { begin = std::min(begin, other.begin), end = std::max(end, other.end); }
};

/// A frame in a palette's colours, and the properties of its pixels that bound invisible changes. Planes of bytes, row
/// by row from the top.
struct IndexedFrame {
  int width = 0, height = 0;
  std::vector<std::uint32_t> source;   ///< target colour, 0xRRGGBB
  std::vector<std::uint8_t> index;     ///< palette index, with dither
  std::vector<std::uint8_t> contrast;  ///< largest step in brightness (0…255) to the four neighbours
  std::vector<std::uint8_t> moved;     ///< 1: the source differs from the previous frame
  std::vector<Span> touched;           ///< per row: all pixels outside equal the previous frame

  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// Converts a film's frames to a palette's colours: for each pixel the nearest one. In smooth areas it first adds
/// Bayer's 8×8 ordered pattern ("An optimum method for two-level rendition of continuous-tone pictures", 1973), with an
/// amplitude that grows with the distance between the palette's colours there. The pattern is fixed, so still areas do
/// not flicker. Pixels with a colour of the palette keep it.
class OrderedDither {
 public:
  OrderedDither(const Palette& palette, int width, int height);

  /// @returns the converted frame, valid until the next call
  const IndexedFrame& apply(const Image& image);

 private:
  struct Nearest {
    std::uint8_t index = Palette::transparent;  // transparent: not yet determined
    bool same = false;                          // true: exactly this colour
  };

  void take_source(const Image& image);
  void find_contrast(int y);
  void find_indices(int y);
  [[nodiscard]] int squared_distance(int index, std::uint32_t color) const;
  const Nearest& nearest(std::uint32_t color);
  [[nodiscard]] std::uint8_t* brightness(int x, int y);

  std::array<std::array<int, 256>, 3> channels_;  // of the palette's colours
  std::array<int, 256> amplitude_;                // of the pattern, around each colour [1/255]
  std::array<std::array<int, 8>, 8> pattern_;
  ColorTable<Nearest> nearest_;
  IndexedFrame frame_;
  Image last_;
  std::vector<Span> moved_;               // per row, the pixels that may have moved
  std::vector<std::uint8_t> brightness_;  // each row has copies of its first and last pixel at its ends
  bool first_ = true;
};

}  // namespace drape::gif
