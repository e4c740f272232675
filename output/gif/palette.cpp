#include "output/gif/palette.hpp"

#include <algorithm>

#include "output/gif/color_cut.hpp"

namespace drape::gif {

Palette make_palette(const ColorHistogram& histogram) {
  std::vector<ColorCount> colors = histogram.colors();
  std::uint64_t total = 0;
  for (const ColorCount& c : colors) total += c.count;
  constexpr std::uint64_t most_exact = 50;
  const auto frequent = [total](const ColorCount& c) { return c.count * most_exact > total; };

  Palette palette;
  for (const ColorCount& c : colors) {
    if (frequent(c)) palette.exact.push_back(c.color);
  }
  std::sort(palette.exact.begin(), palette.exact.end());
  std::erase_if(colors, frequent);

  const std::size_t opaque = palette.colors.size() - 1;
  const std::vector<std::uint32_t> others = representative_colors(std::move(colors), opaque - palette.exact.size());
  const auto next = std::copy(palette.exact.begin(), palette.exact.end(), palette.colors.begin() + 1);
  std::copy(others.begin(), others.end(), next);
  return palette;
}

}  // namespace drape::gif
