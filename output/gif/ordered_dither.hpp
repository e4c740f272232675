#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "output/gif/color_table.hpp"
#include "output/gif/indexed_frame.hpp"
#include "output/gif/palette.hpp"
#include "render/image.hpp"

namespace drape::gif {

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
