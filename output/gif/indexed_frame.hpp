#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

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

}  // namespace drape::gif
