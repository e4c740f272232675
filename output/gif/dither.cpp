#include "output/gif/dither.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "output/gif/compactor.hpp"

namespace drape::gif {
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
