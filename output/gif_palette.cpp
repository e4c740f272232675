#include "output/gif_palette.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "core/error.hpp"

namespace drape {
namespace {

constexpr std::uint32_t opaque = 0xff000000;
constexpr int most_smooth_contrast = 6;

std::uint32_t* row(const libav::Frame& frame, int y) {
  return reinterpret_cast<std::uint32_t*>(frame->data[0] + static_cast<std::ptrdiff_t>(y) * frame->linesize[0]);
}

int squared_distance(std::uint32_t a, std::uint32_t b) {
  int sum = 0;
  for (int shift = 0; shift <= 16; shift += 8) {
    const int d = static_cast<int>(a >> shift & 0xff) - static_cast<int>(b >> shift & 0xff);
    sum += d * d;
  }
  return sum;
}

/// Bayer's 8×8 matrix: the bits of x^y and y, interleaved from the lowest one up, most significant first.
int bayer(int x, int y) {
  int value = 0;
  for (int bit = 0; bit < 3; ++bit) value = value << 2 | ((x ^ y) >> bit & 1) << 1 | (y >> bit & 1);
  return value;  // 0…63
}

int brightness(const std::uint8_t* color) { return (2 * color[0] + 5 * color[1] + color[2]) / 8; }

}  // namespace

int local_contrast(const Image& image, int x, int y) {
  const int here = brightness(image.at(x, y));
  int most = 0;
  if (x > 0) most = std::max(most, std::abs(brightness(image.at(x - 1, y)) - here));
  if (y > 0) most = std::max(most, std::abs(brightness(image.at(x, y - 1)) - here));
  if (x + 1 < image.width) most = std::max(most, std::abs(brightness(image.at(x + 1, y)) - here));
  if (y + 1 < image.height) most = std::max(most, std::abs(brightness(image.at(x, y + 1)) - here));
  return most;
}

GifPaletteBuilder::GifPaletteBuilder(int width, int height)
    : graph_(fmt::format("buffer@film=width={}:height={}:pix_fmt={}:time_base=1/100, "
                         "palettegen=stats_mode=full:reserve_transparent=1, buffersink@palette",
                         width, height, static_cast<int>(AV_PIX_FMT_RGB32))) {}

void GifPaletteBuilder::add(const Image& image) {
  libav::Frame frame = libav::rgb32_frame(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    std::uint32_t* out = row(frame, y);
    for (int x = 0; x < image.width; ++x) out[x] = opaque | rgb_number(image.at(x, y));
  }
  graph_.push("buffer@film", std::move(frame));
  frequent_.add(image);
}

GifPalette GifPaletteBuilder::finish() {
  graph_.push("buffer@film", nullptr);
  const libav::Frame frame = graph_.pull("buffersink@palette");
  if (!frame || frame->width != 16 || frame->height != 16) throw OutputError("FFmpeg's palettegen made no palette");
  GifPalette palette;
  for (int y = 0; y < 16; ++y) std::copy_n(row(frame, y), 16, palette.colors.begin() + 16 * y);
  palette.exact = frequent_.colors();
  force_exact_colors(palette);
  return palette;
}

void force_exact_colors(GifPalette& palette) {
  auto& colors = palette.colors;
  std::vector<bool> taken(colors.size());
  for (std::size_t i = 0; i < colors.size(); ++i) taken[i] = colors[i] < opaque;
  for (const std::uint32_t color : palette.exact) {
    std::size_t nearest = colors.size();
    int least = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const int distance = squared_distance(colors[i], color);
      if (taken[i] || distance >= least) continue;
      nearest = i;
      least = distance;
    }
    colors[nearest] = opaque | color;  // there are fewer exact colours than entries
    taken[nearest] = true;
  }
}

OrderedDither::OrderedDither(const GifPalette& palette) : in_palette_(1 << 24) {
  for (const std::uint32_t entry : palette.colors) {
    if (entry >= opaque) in_palette_[entry & ~opaque] = true;
  }
  // About the distance between neighbouring colours of a film's palette: less leaves bands, more makes grain.
  constexpr int amplitude = 4;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) offset_[y][x] = (2 * bayer(x, y) - 63) * amplitude / 126;  // −amplitude/2 … amplitude/2
  }
}

libav::Frame OrderedDither::apply(const Image& image) const {
  libav::Frame frame = libav::rgb32_frame(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    std::uint32_t* out = row(frame, y);
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* pixel = image.at(x, y);
      const std::uint32_t color = rgb_number(pixel);
      const bool smooth = local_contrast(image, x, y) <= most_smooth_contrast;
      const int offset = in_palette_[color] || !smooth ? 0 : offset_[y % 8][x % 8];
      out[x] = opaque;
      for (int channel = 0; channel < 3; ++channel) {
        out[x] |= static_cast<std::uint32_t>(std::clamp(pixel[channel] + offset, 0, 255)) << (16 - 8 * channel);
      }
    }
  }
  return frame;
}

}  // namespace drape
