#include "render/encode/gif_compactor.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace drape {
namespace {

/// Squared, weighted by how much of the brightness each channel makes. A difference of d in all channels gives 9·d².
int color_error(std::uint32_t a, const std::uint8_t* b) {
  const int red = static_cast<int>(a >> 16 & 0xff) - b[0];
  const int green = static_cast<int>(a >> 8 & 0xff) - b[1];
  const int blue = static_cast<int>(a & 0xff) - b[2];
  return 2 * red * red + 4 * green * green + 3 * blue * blue;
}

int brightness(const std::uint8_t* color) { return (2 * color[0] + 5 * color[1] + color[2]) / 8; }

/// The largest step in brightness to one of the four neighbours.
int contrast(const Image& image, int x, int y) {
  const int here = brightness(image.at(x, y));
  int most = 0;
  if (x > 0) most = std::max(most, std::abs(brightness(image.at(x - 1, y)) - here));
  if (y > 0) most = std::max(most, std::abs(brightness(image.at(x, y - 1)) - here));
  if (x + 1 < image.width) most = std::max(most, std::abs(brightness(image.at(x + 1, y)) - here));
  if (y + 1 < image.height) most = std::max(most, std::abs(brightness(image.at(x, y + 1)) - here));
  return most;
}

}  // namespace

void GifCompactor::Dictionary::clear() {
  first_child_.fill(-1);
  // 256 symbols, the code that clears and the one that ends.
  size_ = 258;
}

void GifCompactor::Dictionary::extend(int entry, int symbol) {
  symbol_[size_] = static_cast<std::uint8_t>(symbol);
  next_sibling_[size_] = first_child_[entry];
  first_child_[entry] = static_cast<std::int16_t>(size_);
  if (++size_ >= capacity - 1) clear();
}

GifCompactor::GifCompactor(GifPalette palette) : palette_(std::move(palette)) {
  const auto is_transparent = [](std::uint32_t color) { return color >> 24 == 0; };
  const auto found = std::find_if(palette_.colors.begin(), palette_.colors.end(), is_transparent);
  transparent_ = static_cast<int>(found - palette_.colors.begin());
}

bool GifCompactor::is_fixed(std::size_t pixel, const Image& source) const {
  const std::uint8_t* color = source.pixels.data() + 3 * pixel;
  if (!shown_.empty() && std::equal(color, color + 3, last_source_.pixels.data() + 3 * pixel)) return true;
  return std::binary_search(palette_.exact.begin(), palette_.exact.end(), rgb_number(color));
}

/// Undoes what has changed though its source has not, and finds the rectangle of what has changed, which is the part
/// that the encoder stores.
GifCompactor::Box GifCompactor::keep_what_stays(AVFrame& frame, const Image& source) const {
  if (shown_.empty()) return {0, 0, frame.width, frame.height};
  Box box{frame.width, frame.height, 0, 0};
  std::size_t pixel = 0;
  for (int y = 0; y < frame.height; ++y) {
    std::uint8_t* row = frame.data[0] + static_cast<std::ptrdiff_t>(y) * frame.linesize[0];
    for (int x = 0; x < frame.width; ++x, ++pixel) {
      const std::uint8_t* color = source.pixels.data() + 3 * pixel;
      if (std::equal(color, color + 3, last_source_.pixels.data() + 3 * pixel)) row[x] = shown_[pixel];
      if (row[x] == shown_[pixel]) continue;
      box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1), std::max(box.bottom, y + 1)};
    }
  }
  return box;
}

/// Of the entries that extend `entry`, the one by the wanted symbol, or else by the nearest colour; −1 if there is
/// none.
int GifCompactor::choose(int entry, int wanted, std::size_t pixel, const std::uint8_t* color, int most_error) const {
  int best = -1;
  for (int child = dictionary_.first_child(entry); child >= 0; child = dictionary_.next_sibling(child)) {
    const int symbol = dictionary_.symbol(child);
    if (symbol == wanted) return child;
    if (most_error == 0) continue;
    const bool stays = symbol == transparent_;
    if (shown_.empty() ? stays : !stays && symbol == shown_[pixel]) continue;  // the encoder writes neither
    const int error = color_error(palette_.colors[stays ? shown_[pixel] : symbol], color);
    if (error > most_error || (best >= 0 && error == most_error)) continue;
    best = child;
    most_error = error;
  }
  return best;
}

void GifCompactor::compact(AVFrame& frame, const Image& source, int tolerance) {
  const Box box = keep_what_stays(frame, source);
  dictionary_.clear();
  int entry = -1;
  for (int y = box.top; y < box.bottom; ++y) {
    std::uint8_t* row = frame.data[0] + static_cast<std::ptrdiff_t>(y) * frame.linesize[0];
    for (int x = box.left; x < box.right; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) + x;
      const bool stays = !shown_.empty() && row[x] == shown_[pixel];
      const int wanted = stays ? transparent_ : row[x];
      int most_error = 0;
      if (tolerance > 0 && !is_fixed(pixel, source)) {
        // Where the picture is smooth, all of the tolerance would show as streaks.
        const int allowed = std::min(tolerance, 2 + tolerance / 8 + contrast(source, x, y));
        most_error = 9 * allowed * allowed;
      }
      const int next = entry < 0 ? -1 : choose(entry, wanted, pixel, source.at(x, y), most_error);
      if (next >= 0) {
        const int symbol = dictionary_.symbol(next);
        row[x] = symbol == transparent_ ? shown_[pixel] : static_cast<std::uint8_t>(symbol);
        entry = next;
      } else {
        if (entry >= 0) dictionary_.extend(entry, wanted);
        entry = wanted;
      }
    }
  }
  shown_.clear();
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* row = frame.data[0] + static_cast<std::ptrdiff_t>(y) * frame.linesize[0];
    shown_.insert(shown_.end(), row, row + frame.width);
  }
  last_source_ = source;
}

}  // namespace drape
