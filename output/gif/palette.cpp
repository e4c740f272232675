#include "output/gif/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

namespace drape::gif {

/// Counts the stretch that begins at a byte of the last frame.
void ColorHistogram::count(std::size_t first_byte) {
  const std::uint64_t shown = frames_ - std::exchange(since_[first_byte / stretch], frames_);
  const std::size_t end = std::min(first_byte + stretch, last_.pixels.size());
  for (std::size_t i = first_byte; i < end; i += 3) counts_[rgb_number(&last_.pixels[i])] += shown;
}

void ColorHistogram::add(const Image& image) {
  const std::size_t size = image.pixels.size();
  if (frames_ == 0) {
    last_ = image;
    since_.assign((size + stretch - 1) / stretch, 0);
  }
  for (std::size_t first = 0; first < size; first += stretch) {
    const std::size_t length = std::min(stretch, size - first);
    std::uint8_t* before = &last_.pixels[first];
    const std::uint8_t* now = &image.pixels[first];
    if (std::memcmp(before, now, length) == 0) continue;
    count(first);
    std::memcpy(before, now, length);
  }
  ++frames_;
}

std::vector<ColorCount> ColorHistogram::colors() {
  for (std::size_t first = 0; first < last_.pixels.size(); first += stretch) count(first);
  std::vector<ColorCount> found;
  counts_.for_each([&found](std::uint32_t color, std::uint64_t count) {
    if (count > 0) found.push_back({color, count});
  });
  return found;
}

namespace {

int channel(std::uint32_t color, int axis) { return static_cast<int>(color >> (16 - 8 * axis) & 0xff); }

/// Zeroth and first moments of a set of colours.
struct Moments {
  double count = 0;
  std::array<double, 3> sum{};

  void add(const ColorCount& c) {
    const auto n = static_cast<double>(c.count);
    count += n;
    for (int axis = 0; axis < 3; ++axis) sum[axis] += n * channel(c.color, axis);
  }
  void operator+=(const Moments& other) {
    count += other.count;
    for (int axis = 0; axis < 3; ++axis) sum[axis] += other.sum[axis];
  }
  [[nodiscard]] Moments operator-(const Moments& other) const {
    Moments rest = *this;
    rest.count -= other.count;
    for (int axis = 0; axis < 3; ++axis) rest.sum[axis] -= other.sum[axis];
    return rest;
  }
  /// Returns how much smaller the squared error is around the mean than around zero.
  [[nodiscard]] double explained() const {
    return count > 0 ? (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / count : 0;
  }
  [[nodiscard]] std::uint32_t mean() const {
    std::uint32_t color = 0;
    for (const double s : sum) color = color << 8 | static_cast<std::uint32_t>(std::lround(s / count));
    return color;
  }
};

constexpr int hues = 12;

/// Returns the twelfth of the hue circle of a colour, 1…12, the first centred on red; 0 for a nearly grey colour.
int hue(std::uint32_t color) {
  constexpr int least_chroma = 24;
  const int r = red(color), g = green(color), b = blue(color);
  const int most = std::max({r, g, b}), chroma = most - std::min({r, g, b});
  if (chroma < least_chroma) return 0;
  // The side of the hue hexagon, of six, and the position along it.
  const int along = most == r ? g - b : most == g ? b - r : r - g;
  const int side = most == r ? 0 : most == g ? 2 : 4;
  const int twelfth = (hues * chroma + 2 * side * chroma + 2 * along + chroma / 2) / chroma;
  return 1 + twelfth % hues;
}

/// A set of colours, with the plane that best cuts it in two.
struct Box {
  std::span<ColorCount> colors;
  Moments moments;
  int axis = 0, first_above = 0;  // colours whose channel reaches this are above the plane
  double gain = 0;                // reduction of the squared error by the cut

  explicit Box(std::span<ColorCount> all) : colors(all) {
    std::array<std::array<Moments, 256>, 3> slices{};
    for (const ColorCount& c : colors) {
      moments.add(c);
      for (int a = 0; a < 3; ++a) slices[a][channel(c.color, a)].add(c);
    }
    for (int a = 0; a < 3; ++a) {
      Moments below;
      for (int value = 0; value < 255; ++value) {
        below += slices[a][value];
        const Moments above = moments - below;
        if (below.count == 0 || above.count == 0) continue;
        const double reduction = below.explained() + above.explained() - moments.explained();
        if (reduction > gain) gain = reduction, axis = a, first_above = value + 1;
      }
    }
  }

  /// Cuts off and returns the part above the plane.
  Box cut() {
    const auto middle = std::partition(colors.begin(), colors.end(),
                                       [this](const ColorCount& c) { return channel(c.color, axis) < first_above; });
    const auto size = static_cast<std::size_t>(middle - colors.begin());
    const Box above(colors.subspan(size));
    *this = Box(colors.first(size));
    return above;
  }
};

Box& most_worth(std::span<Box> boxes) {
  return *std::max_element(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.gain < b.gain; });
}

/// Returns boxes reserved for hues, at most half of all, so that a red ball in few frames keeps colours of its own
/// beside a cloth in all frames. The last box holds the rest: greys, and hues only of pixels on edges.
std::vector<Box> boxes_of_hues(std::span<ColorCount> colors, std::size_t most) {
  constexpr double least_share = 1e-4;
  constexpr double unseen = 2;  // least gain per pixel in squared error that is worth an entry
  std::array<double, 1 + hues> pixels{};
  double total = 0;
  for (const ColorCount& c : colors) {
    pixels[static_cast<std::size_t>(hue(c.color))] += static_cast<double>(c.count);
    total += static_cast<double>(c.count);
  }
  const auto frequent = [&](double count) { return count > least_share * total; };
  const auto present = static_cast<std::size_t>(std::count_if(pixels.begin() + 1, pixels.end(), frequent));
  const std::size_t reserved = std::min(std::size_t{24}, most / 2 / std::max(present, std::size_t{1}));  // for each hue

  std::vector<Box> boxes;
  for (int h = 1; h <= hues; ++h) {
    if (!frequent(pixels[static_cast<std::size_t>(h)])) continue;
    const auto end =
        std::partition(colors.begin(), colors.end(), [h](const ColorCount& c) { return hue(c.color) == h; });
    const auto count = static_cast<std::size_t>(end - colors.begin());
    std::vector<Box> own{Box(colors.first(count))};
    for (colors = colors.subspan(count); own.size() < reserved;) {
      Box& worst = most_worth(own);
      if (worst.gain <= unseen * worst.moments.count) break;
      own.push_back(worst.cut());
    }
    boxes.insert(boxes.end(), own.begin(), own.end());
  }
  if (!colors.empty()) boxes.push_back(Box(colors));
  return boxes;
}

}  // namespace

std::vector<std::uint32_t> representative_colors(std::vector<ColorCount> colors, std::size_t most) {
  std::vector<std::uint32_t> chosen;
  if (colors.size() <= most) {
    for (const ColorCount& c : colors) chosen.push_back(c.color);
    return chosen;
  }
  std::vector<Box> boxes = boxes_of_hues(colors, most);
  while (boxes.size() < most) {
    Box& worst = most_worth(boxes);
    if (worst.gain <= 0) break;
    boxes.push_back(worst.cut());
  }
  for (const Box& box : boxes) chosen.push_back(box.moments.mean());
  return chosen;
}

Palette make_palette(ColorHistogram& histogram) {
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
