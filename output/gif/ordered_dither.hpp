#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "output/gif/color_table.hpp"
#include "output/gif/indexed_frame.hpp"
#include "output/gif/palette.hpp"
#include "render/image.hpp"

namespace drape::gif {

/// Takes the frames of a film, one after the other, to a palette's colours: for each pixel the nearest one. Where the
/// picture is smooth it first adds the 8×8 ordered pattern of Bayer ("An optimum method for two-level rendition of
/// continuous-tone pictures", 1973) to the pixels whose colour is not in the palette, the higher the farther apart the
/// palette's colours are there. The pattern stays in place, so what does not move does not flicker, and what has a
/// colour of the palette keeps it.
class OrderedDither {
 public:
  OrderedDither(const Palette& palette, int width, int height);

  /// @returns the frame, valid until the next one
  const IndexedFrame& apply(const Image& image);

 private:
  struct Nearest {
    std::uint8_t index = Palette::transparent;  // not looked for yet
    bool same = false;                          // it is that very colour
  };

  void take_source(const Image& image);
  void find_contrast(int y);
  void find_indices(int y);
  [[nodiscard]] int squared_distance(int index, std::uint32_t color) const;
  const Nearest& nearest(std::uint32_t color);
  [[nodiscard]] std::uint8_t* brightness(int x, int y);

  std::array<std::array<int, 256>, 3> channels_;  // of the palette's colours
  std::array<int, 256> amplitude_;                // of the pattern, around each of them [1/255]
  std::array<std::array<int, 8>, 8> pattern_;
  ColorTable<Nearest> nearest_;
  IndexedFrame frame_;
  Image last_;
  std::vector<Span> moved_;               // of each row, the pixels that may have moved
  std::vector<std::uint8_t> brightness_;  // with a copy of the first and the last pixel at the ends of each row
  bool first_ = true;
};

}  // namespace drape::gif
