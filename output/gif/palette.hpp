#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "drape/render/image.hpp"

namespace drape::gif {

/// Returns 0xRRGGBB of a pixel's three bytes.
inline std::uint32_t rgb_number(const std::uint8_t* pixel) {
  return static_cast<std::uint32_t>(pixel[0] << 16 | pixel[1] << 8 | pixel[2]);
}

inline int red(std::uint32_t color) { return static_cast<int>(color >> 16 & 0xff); }
inline int green(std::uint32_t color) { return static_cast<int>(color >> 8 & 0xff); }
inline int blue(std::uint32_t color) { return static_cast<int>(color & 0xff); }

/// A value for each of the 2²⁴ colours 0xRRGGBB, initially T{}. Memory is allocated per used cube of 16×16×16 colours:
/// a film's colours lie in few cubes, and neighbouring pixels mostly in the same.
template <class T>
class ColorTable {
 public:
  T& operator[](std::uint32_t color) {
    std::unique_ptr<Cube>& cube = cubes_[interleaved(color >> 4)];
    if (!cube) cube = std::make_unique<Cube>();
    return (*cube)[interleaved(color)];
  }

  /// Calls f(color, value) for every colour of the allocated cubes, always in the same order.
  template <class F>
  void for_each(F f) const {
    for (std::uint32_t c = 0; c < cubes_.size(); ++c) {
      if (!cubes_[c]) continue;
      for (std::uint32_t i = 0; i < side * side * side; ++i) f(spread(c) << 4 | spread(i), (*cubes_[c])[i]);
    }
  }

 private:
  static constexpr std::size_t side = 16;
  using Cube = std::array<T, side * side * side>;

  /// Converts 0x-R-G-B to 0xRGB.
  static std::uint32_t interleaved(std::uint32_t c) { return (c >> 8 & 0xf00) | (c >> 4 & 0xf0) | (c & 0xf); }
  /// Inverts interleaved().
  static std::uint32_t spread(std::uint32_t c) { return (c & 0xf00) << 8 | (c & 0xf0) << 4 | (c & 0xf); }

  std::array<std::unique_ptr<Cube>, side * side * side> cubes_;
};

/// A colour and its number of pixels.
struct ColorCount {
  std::uint32_t color = 0;  ///< 0xRRGGBB
  std::uint64_t count = 0;
};

/// Counts every colour of a film separately. Stretches of pixels that stay the same are counted once, for all the
/// frames that showed them.
class ColorHistogram {
 public:
  /// @param image the film's next frame, of the same size as the others
  void add(const Image& image);

  /// Returns each colour once, in an order that depends only on the set of colours.
  [[nodiscard]] std::vector<ColorCount> colors();

 private:
  static constexpr std::size_t stretch = 96;  // [bytes]

  void count(std::size_t first_byte);

  ColorTable<std::uint64_t> counts_;
  Image last_;
  std::vector<std::uint64_t> since_;  // per stretch of the last frame: the first frame that is not counted
  std::uint64_t frames_ = 0;
};

/// Chooses at most `most` colours that represent the given ones; few given colours are returned unchanged.
///
/// The colours are cut into boxes (Heckbert, "Color image quantization for frame buffer display", 1982), each time
/// where the squared error of all pixels falls most (Wu, "Color quantization by dynamic programming and principal
/// analysis", 1992). Each box becomes its mean.
std::vector<std::uint32_t> representative_colors(std::vector<ColorCount> colors, std::size_t most);

/// The colours of a GIF, by index.
struct Palette {
  static constexpr int transparent = 0;     ///< index that keeps the previous pixel
  std::array<std::uint32_t, 256> colors{};  ///< 0xRRGGBB; unused for the transparent index
  std::vector<std::uint32_t> exact;         ///< 0xRRGGBB, ascending: colours that pixels must keep exactly
};

/// Chooses the colours of a GIF for a film.
Palette make_palette(ColorHistogram& histogram);

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
