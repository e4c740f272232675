#include "overlay/color_bar.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "overlay/color_map.hpp"

namespace drape {

int color_bar_height(int size) { return 2 * Pen::line_height(size) + 2 * size; }

Image color_bar(Pen& pen, int width, int size, const std::string& title, const std::vector<Tick>& marks) {
  Image band(width, color_bar_height(size));
  Pen::fill(band, {0, 0, band.width, band.height}, band_paper);
  const int margin = std::min(2 * size, width / 6), base = size + size / 4;
  pen.write(band, margin, base, title, size, band_ink);
  const PictureBox bar{margin, base + size / 2, width - 2 * margin, size};
  for (int x = 0; x < bar.width; ++x) {
    Pen::fill(band, {bar.left + x, bar.top, 1, bar.height},
              viridis(static_cast<double>(x) / std::max(1, bar.width - 1)));
  }
  const auto column = [&](const Tick& mark) {
    return bar.left + static_cast<int>(std::lround(mark.value * (bar.width - 1)));
  };
  const LabelColumns label = [&](const Tick& mark) {
    const int taken = pen.width(mark.label, size);
    const int left = std::clamp(column(mark) - taken / 2, 0, std::max(0, width - taken));
    return std::pair{left, left + taken};
  };
  for (const Tick& mark : thinned(marks, label, size / 2)) {
    Pen::fill(band, {column(mark), bar.bottom(), 1, std::max(2, size / 4)}, band_ink);
    pen.write(band, label(mark).first, bar.bottom() + size + size / 3, mark.label, size, band_ink);
  }
  return band;
}

}  // namespace drape
