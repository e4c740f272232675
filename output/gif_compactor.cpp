#include "output/gif_compactor.hpp"

#include <algorithm>
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

}  // namespace

void GifCompactor::Dictionary::clear() {
  first_child_.fill(-1);
  // 256 symbols, the code that clears and the one that ends.
  size_ = 258;
}

void GifCompactor::Dictionary::extend(int entry, int symbol) {
  symbol_[size_] = static_cast<std::uint8_t>(symbol);
  parent_[size_] = static_cast<std::int16_t>(entry);
  next_sibling_[size_] = first_child_[entry];
  first_child_[entry] = static_cast<std::int16_t>(size_);
  if (++size_ >= capacity - 1) clear();
}

GifCompactor::GifCompactor(GifPalette palette) : palette_(std::move(palette)) {
  const auto is_transparent = [](std::uint32_t color) { return color >> 24 == 0; };
  const auto found = std::find_if(palette_.colors.begin(), palette_.colors.end(), is_transparent);
  transparent_ = static_cast<int>(found - palette_.colors.begin());
}

bool GifCompactor::is_exact(const std::uint8_t* color) const {
  return std::binary_search(palette_.exact.begin(), palette_.exact.end(), rgb_number(color));
}

/// Undoes what has changed though its source has not, and lists the pixels of the rectangle of what has changed, which
/// is the part that the encoder stores.
std::vector<GifCompactor::Pixel> GifCompactor::changed_pixels(AVFrame& frame, const Image& source, int tolerance) {
  const bool is_first = shown_.empty();
  int left = frame.width, top = frame.height, right = 0, bottom = 0;
  std::vector<Pixel> pixels;
  pixels.reserve(shown_.size());
  for (int y = 0; y < frame.height; ++y) {
    std::uint8_t* row = frame.data[0] + static_cast<std::ptrdiff_t>(y) * frame.linesize[0];
    for (int x = 0; x < frame.width; ++x) {
      const std::size_t i = pixels.size();
      Pixel pixel{row + x, source.at(x, y), is_first ? -1 : shown_[i], 0};
      const bool stays = !is_first && std::equal(pixel.color, pixel.color + 3, last_source_.at(x, y));
      if (stays) *pixel.index = shown_[i];
      if (!stays && tolerance > 0 && !is_exact(pixel.color)) {
        // Where the picture is smooth, all of the tolerance would show as streaks.
        const int allowed = std::min(tolerance, 2 + tolerance / 16 + local_contrast(source, x, y));
        pixel.most_error = 9 * allowed * allowed;
      }
      pixels.push_back(pixel);
      if (*pixel.index == pixel.shown) continue;
      left = std::min(left, x), right = std::max(right, x + 1);
      top = std::min(top, y), bottom = std::max(bottom, y + 1);
    }
  }
  std::vector<Pixel> changed;
  for (int y = top; y < bottom; ++y) {
    const auto row = pixels.begin() + static_cast<std::ptrdiff_t>(y) * frame.width;
    changed.insert(changed.end(), row + left, row + right);
  }
  return changed;
}

/// Of showing a symbol in place of a pixel's own colour; above what is allowed if the encoder would not write it.
int GifCompactor::error(const Pixel& pixel, int symbol) const {
  if (symbol == pixel.symbol(transparent_)) return 0;
  if (pixel.most_error == 0 || symbol == pixel.shown) return pixel.most_error + 1;
  if (symbol == transparent_ && pixel.shown < 0) return pixel.most_error + 1;
  return color_error(palette_.colors[symbol == transparent_ ? pixel.shown : symbol], pixel.color);
}

/// Goes on from a match of the first pixels, as far as there are entries for the next ones.
void GifCompactor::find_longest(std::span<const Pixel> pixels, const Match& match, Match& best) const {
  if (match.length > best.length || (match.length == best.length && match.error < best.error)) best = match;
  if (static_cast<std::size_t>(match.length) == pixels.size()) return;
  const Pixel& pixel = pixels[match.length];
  for (int e = dictionary_.first_child(match.entry); e >= 0; e = dictionary_.next_sibling(e)) {
    const int added = error(pixel, dictionary_.symbol(e));
    if (added <= pixel.most_error) find_longest(pixels, {e, match.length + 1, match.error + added}, best);
  }
}

void GifCompactor::compact(AVFrame& frame, const Image& source, int tolerance) {
  const std::vector<Pixel> pixels = changed_pixels(frame, source, tolerance);
  dictionary_.clear();
  for (std::span<const Pixel> rest = pixels; !rest.empty();) {
    Match best;
    find_longest(rest, {rest[0].symbol(transparent_), 1, 0}, best);
    int entry = best.entry;
    for (int i = best.length - 1; i > 0; --i, entry = dictionary_.parent(entry)) {
      const int symbol = dictionary_.symbol(entry);
      *rest[i].index = static_cast<std::uint8_t>(symbol == transparent_ ? rest[i].shown : symbol);
    }
    rest = rest.subspan(best.length);
    if (!rest.empty()) dictionary_.extend(best.entry, rest[0].symbol(transparent_));
  }
  shown_.clear();
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* row = frame.data[0] + static_cast<std::ptrdiff_t>(y) * frame.linesize[0];
    shown_.insert(shown_.end(), row, row + frame.width);
  }
  last_source_ = source;
}

}  // namespace drape
