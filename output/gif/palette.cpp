#include "output/gif/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include "output/gif/compactor.hpp"

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

namespace {

/// Contrast up to which an area is dithered; coarser areas hide bands themselves.
constexpr int most_smooth_contrast = 6;

/// Returns an entry of Bayer's 8×8 matrix: bits of x^y and y, interleaved from the lowest, most significant first.
int bayer(int x, int y) {
  int value = 0;
  for (int bit = 0; bit < 3; ++bit) value = value << 2 | ((x ^ y) >> bit & 1) << 1 | (y >> bit & 1);
  return value;
}
constexpr int bayer_range = 63;  // largest value; values are 0…63

std::uint32_t shifted(std::uint32_t color, int offset) {
  const auto moved = [offset](int channel) { return static_cast<std::uint32_t>(std::clamp(channel + offset, 0, 255)); };
  return moved(red(color)) << 16 | moved(green(color)) << 8 | moved(blue(color));
}

/// Returns the range from the first to the last pixel that differs between two rows.
Span difference(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  const std::size_t first = next_difference(a, b, 0);
  if (first == a.size()) return {};
  std::size_t end = a.size();
  while (a[end - 1] == b[end - 1]) --end;
  return {static_cast<int>(first / 3), static_cast<int>((end + 2) / 3)};
}

std::uint8_t distance(std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a > b ? a - b : b - a); }

}  // namespace

OrderedDither::OrderedDither(const Palette& palette, int width, int height) : last_(width, height) {
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) pattern_[y][x] = 2 * bayer(x, y) - bayer_range;
  }
  for (std::size_t i = 0; i < palette.colors.size(); ++i) {
    const std::uint32_t color = palette.colors[i];
    channels_[0][i] = red(color), channels_[1][i] = green(color), channels_[2][i] = blue(color);
  }
  constexpr int far_from_all = 1024;
  channels_[0][Palette::transparent] = far_from_all;
  // The amplitude equals the distance to the neighbouring colour: less leaves bands, more makes grain.
  for (std::size_t i = 0; i < amplitude_.size(); ++i) {
    constexpr double least = 2, most = 8;
    int squared = std::numeric_limits<int>::max();
    for (std::size_t j = 0; j < amplitude_.size(); ++j) {
      if (j != i) squared = std::min(squared, squared_distance(static_cast<int>(j), palette.colors[i]));
    }
    amplitude_[i] = static_cast<int>(std::lround(std::clamp(std::sqrt(squared / 3.0), least, most)));
  }

  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const auto rows = static_cast<std::size_t>(height);
  frame_ = {.width = width,
            .height = height,
            .source = std::vector<std::uint32_t>(count),
            .index = std::vector<std::uint8_t>(count),
            .contrast = std::vector<std::uint8_t>(count),
            .moved = std::vector<std::uint8_t>(count),
            .touched = std::vector<Span>(rows)};
  moved_.resize(rows);
  brightness_.resize(rows * (static_cast<std::size_t>(width) + 2));
}

std::uint8_t* OrderedDither::brightness(int x, int y) {
  return &brightness_[static_cast<std::size_t>(y) * (static_cast<std::size_t>(frame_.width) + 2) +
                      static_cast<std::size_t>(x) + 1];
}

int OrderedDither::squared_distance(int index, std::uint32_t color) const {
  const auto i = static_cast<std::size_t>(index);
  const int r = channels_[0][i] - red(color), g = channels_[1][i] - green(color), b = channels_[2][i] - blue(color);
  return r * r + g * g + b * b;
}

const OrderedDither::Nearest& OrderedDither::nearest(std::uint32_t color) {
  Nearest& found = nearest_[color];
  if (found.index != Palette::transparent) return found;
  std::array<int, 256> ranked;  // squared distance in the upper bits, index in the lowest eight
  for (int i = 0; i < 256; ++i) {
    ranked[i] = squared_distance(i, color) << 8 | i;
  }
  int least = std::numeric_limits<int>::max();
  for (const int candidate : ranked) least = std::min(least, candidate);
  found = {static_cast<std::uint8_t>(least & 0xff), least >> 8 == 0};
  return found;
}

/// Stores the image and marks the pixels that have moved.
void OrderedDither::take_source(const Image& image) {
  const std::size_t row_size = 3 * static_cast<std::size_t>(frame_.width);
  for (int y = 0; y < frame_.height; ++y) {
    std::uint8_t* moved = &frame_.moved[frame_.at(0, y)];
    Span& span = moved_[static_cast<std::size_t>(y)];
    if (!span.empty()) std::fill(moved + span.begin, moved + span.end, std::uint8_t{0});
    span = first_ ? Span{0, frame_.width} : difference({image.at(0, y), row_size}, {last_.at(0, y), row_size});
    if (span.empty()) continue;
    const std::uint8_t* now = image.at(0, y);
    std::copy(image.at(span.begin, y), now + std::ptrdiff_t{3} * span.end, last_.at(span.begin, y));
    std::uint32_t* source = &frame_.source[frame_.at(0, y)];
    std::uint8_t* bright = brightness(0, y);
    for (int x = span.begin; x < span.end; ++x) {
      const std::uint32_t color = rgb_number(now + std::ptrdiff_t{3} * x);
      moved[x] = first_ || color != source[x];
      source[x] = color;
      bright[x] = static_cast<std::uint8_t>((2 * red(color) + 5 * green(color) + blue(color)) / 8);
    }
    bright[-1] = bright[0];
    bright[frame_.width] = bright[frame_.width - 1];
  }
}

void OrderedDither::find_contrast(int y) {
  const Span span = frame_.touched[static_cast<std::size_t>(y)];
  const std::uint8_t* here = brightness(0, y);
  const std::uint8_t* above = brightness(0, std::max(y - 1, 0));
  const std::uint8_t* below = brightness(0, std::min(y + 1, frame_.height - 1));
  std::uint8_t* contrast = &frame_.contrast[frame_.at(0, y)];
  for (int x = span.begin; x < span.end; ++x) {
    const std::uint8_t across = std::max(distance(here[x - 1], here[x]), distance(here[x + 1], here[x]));
    const std::uint8_t along = std::max(distance(above[x], here[x]), distance(below[x], here[x]));
    contrast[x] = std::max(across, along);
  }
}

void OrderedDither::find_indices(int y) {
  const Span span = frame_.touched[static_cast<std::size_t>(y)];
  const std::size_t row = frame_.at(0, y);
  for (int x = span.begin; x < span.end; ++x) {
    const std::size_t i = row + static_cast<std::size_t>(x);
    const Nearest& plain = nearest(frame_.source[i]);
    int offset = 0;
    if (!plain.same && frame_.contrast[i] <= most_smooth_contrast) {
      offset = pattern_[y % 8][x % 8] * amplitude_[plain.index] / (2 * bayer_range);
    }
    frame_.index[i] = offset == 0 ? plain.index : nearest(shifted(frame_.source[i], offset)).index;
  }
}

const IndexedFrame& OrderedDither::apply(const Image& image) {
  take_source(image);
  for (int y = 0; y < frame_.height; ++y) {
    // Contrast depends on the neighbours, so neighbouring pixels are recomputed too.
    const auto row = static_cast<std::size_t>(y);
    Span& span = frame_.touched[row] = moved_[row];
    if (y > 0) span.include(moved_[row - 1]);
    if (y + 1 < frame_.height) span.include(moved_[row + 1]);
    if (span.empty()) continue;
    span = {std::max(span.begin - 1, 0), std::min(span.end + 1, frame_.width)};
    find_contrast(y);
    find_indices(y);
  }
  first_ = false;
  return frame_;
}

}  // namespace drape::gif
