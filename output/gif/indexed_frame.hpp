#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace drape::gif {

/// Pixels of a row from `begin` to before `end`; empty where these are not in order.
struct Span {
  int begin = 1 << 30, end = 0;

  [[nodiscard]] bool empty() const { return begin >= end; }
  void include(const Span& other) { begin = std::min(begin, other.begin), end = std::max(end, other.end); }
};

/// A frame in a palette's colours, and what has to be known of its pixels to change them unseen. Planes of bytes, row
/// by row from the top.
struct IndexedFrame {
  int width = 0, height = 0;
  std::vector<std::uint32_t> source;   ///< what is to be shown: 0xRRGGBB
  std::vector<std::uint8_t> index;     ///< the palette's colour for it, with dither
  std::vector<std::uint8_t> contrast;  ///< the largest step in brightness (0…255) to the four neighbours
  std::vector<std::uint8_t> moved;     ///< 1: the source is another than in the frame before
  std::vector<Span> touched;           ///< of each row: outside of it, all is as it was in the frame before

  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

}  // namespace drape::gif
