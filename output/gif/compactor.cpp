#include "output/gif/compactor.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "drape/core/error.hpp"
#include "output/gif/palette.hpp"

namespace drape::gif {
namespace {

/// Lengths of the next unchanged and replaced stretches [bytes].
struct Lengths {
  std::uint32_t kept = 0, replaced = 0;
};

using Word = std::uint64_t;  // bytes compared at once

Word word(const std::uint8_t* bytes) {
  Word value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// Returns the first position from `begin` where the equal stretch is longer than its description.
std::size_t next_stay(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b, std::size_t begin) {
  std::size_t i = begin;
  for (; i + 2 * sizeof(Word) <= a.size(); i += sizeof(Word)) {
    if (word(&a[i]) == word(&b[i]) && word(&a[i + sizeof(Word)]) == word(&b[i + sizeof(Word)])) return i;
  }
  return a.size();
}

}  // namespace

std::size_t next_difference(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b, std::size_t begin) {
  std::size_t i = begin;
  while (i + sizeof(Word) <= a.size() && word(&a[i]) == word(&b[i])) i += sizeof(Word);
  while (i < a.size() && a[i] == b[i]) ++i;
  return i;
}

void pack_difference(std::span<const std::uint8_t> before, std::span<const std::uint8_t> now,
                     std::vector<std::uint8_t>& packed) {
  packed.clear();
  for (std::size_t i = 0; i < now.size();) {
    const std::size_t differs = next_difference(before, now, i);
    const std::size_t end = next_stay(before, now, differs);
    const Lengths lengths{static_cast<std::uint32_t>(differs - i), static_cast<std::uint32_t>(end - differs)};
    const auto* header = reinterpret_cast<const std::uint8_t*>(&lengths);
    packed.insert(packed.end(), header, header + sizeof lengths);
    packed.insert(packed.end(), now.begin() + static_cast<std::ptrdiff_t>(differs),
                  now.begin() + static_cast<std::ptrdiff_t>(end));
    i = end;
  }
}

bool apply_difference(std::span<const std::uint8_t> packed, std::span<std::uint8_t> frame) {
  while (!packed.empty()) {
    Lengths lengths;
    if (packed.size() < sizeof lengths) return false;
    std::memcpy(&lengths, packed.data(), sizeof lengths);
    packed = packed.subspan(sizeof lengths);
    if (lengths.kept > frame.size()) return false;
    frame = frame.subspan(lengths.kept);
    if (lengths.replaced > frame.size() || lengths.replaced > packed.size()) return false;
    std::copy_n(packed.begin(), lengths.replaced, frame.begin());
    frame = frame.subspan(lengths.replaced);
    packed = packed.subspan(lengths.replaced);
  }
  return frame.empty();
}

FrameSpool::FrameSpool(const PartialFile& output) : spool_(output, "its frames") {}

void FrameSpool::append(const Image& image) {
  if (count_ == 0) last_ = Image(image.width, image.height);
  if (image.width != last_.width || image.height != last_.height) {
    throw std::invalid_argument("the frames of a film must have one size");
  }
  pack_difference(last_.pixels, image.pixels, packed_);
  last_.pixels = image.pixels;

  const std::uint64_t size = packed_.size();
  spool_.append({reinterpret_cast<const char*>(&size), sizeof size});
  spool_.append({reinterpret_cast<const char*>(packed_.data()), size});
  ++count_;
}

void FrameSpool::rewind() {
  spool_.rewind();
  std::fill(last_.pixels.begin(), last_.pixels.end(), std::uint8_t{0});
}

const Image& FrameSpool::next() {
  std::uint64_t size = 0;
  spool_.read(&size, sizeof size);
  packed_.resize(size);
  spool_.read(packed_.data(), size);
  if (!apply_difference(packed_, last_.pixels)) throw OutputError("a frame kept on disk has changed there");
  return last_;
}

namespace {

constexpr int symbol_bits = LzwDictionary::symbol_bits, least_width = symbol_bits + 1,
              most_width = LzwDictionary::code_bits;
constexpr std::size_t most_of_block = 255;

}  // namespace

void LzwDictionary::clear() {
  size_ = end_code + 1;
  entries_.fill({});
  children_.fill(0);
}

void LzwDictionary::extend(int entry, int symbol) {
  entries_[size_] = {.next_sibling = entries_[entry].first_child,
                     .parent = static_cast<std::int16_t>(entry),
                     .symbol = static_cast<std::uint8_t>(symbol)};
  entries_[entry].first_child = static_cast<std::int16_t>(size_);
  if (symbol == 0) entries_[entry].zero_child = static_cast<std::int16_t>(size_);
  entries_[entry].symbols |= static_cast<std::uint8_t>(1 << symbol % 8);
  const auto key = static_cast<std::uint32_t>(entry << symbol_bits | symbol);
  std::uint32_t k = slot(key);
  while (children_[k] != 0) k = (k + 1) % slots;
  children_[k] = key << code_bits | static_cast<std::uint32_t>(size_);
  ++size_;
}

LzwCodes::LzwCodes() : bytes_{static_cast<char>(symbol_bits), '\0'}, block_(1), width_(least_width) { put_clear(); }

void LzwCodes::put_byte() {
  if (bytes_.size() - block_ > most_of_block) {
    bytes_[block_] = static_cast<char>(most_of_block);
    block_ = bytes_.size();
    bytes_.push_back('\0');
  }
  bytes_.push_back(static_cast<char>(bits_ & 0xff));
  bits_ >>= 8;
  bit_count_ -= 8;
}

void LzwCodes::put_bits(int code) {
  bits_ |= static_cast<std::uint32_t>(code) << bit_count_;
  for (bit_count_ += width_; bit_count_ >= 8;) put_byte();
}

void LzwCodes::put(int code, int size) {
  put_bits(code);
  if (size == 1 << width_ && width_ < most_width) ++width_;
}

void LzwCodes::put_clear() {
  put_bits(LzwDictionary::clear_code);
  width_ = least_width;
}

std::string LzwCodes::finish() {
  put_bits(LzwDictionary::end_code);
  if (bit_count_ > 0) put_byte();
  bytes_[block_] = static_cast<char>(bytes_.size() - block_ - 1);
  if (bytes_[block_] != '\0') bytes_.push_back('\0');
  return std::move(bytes_);
}

namespace {

/// Returns the squared error, channels weighted by brightness. A difference of d in all channels gives 9·d².
int color_error(std::uint32_t a, std::uint32_t b) {
  const int r = red(a) - red(b), g = green(a) - green(b), bl = blue(a) - blue(b);
  return 2 * r * r + 4 * g * g + 3 * bl * bl;
}

/// Error of the dither that stays invisible.
constexpr int unseen_error = 9 * 4 * 4;

}  // namespace

Compactor::Compactor(const Palette& palette, int width, int height)
    : palette_(palette),
      height_(height),
      shown_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), Palette::transparent),
      touched_(static_cast<std::size_t>(height)),
      late_(shown_.size()) {}

bool Compactor::is_exact(std::uint32_t color) const {
  return std::binary_search(palette_.exact.begin(), palette_.exact.end(), color);
}

/// Returns the error that a pixel may have for longer than one frame.
int Compactor::lasting_error(const IndexedFrame& frame, std::size_t i) const {
  return std::max(color_error(palette_.colors[frame.index[i]], frame.source[i]), unseen_error);
}

bool Compactor::may_stay(const IndexedFrame& frame, std::size_t i) const {
  if (frame.index[i] == shown_[i]) return true;
  return color_error(palette_.colors[shown_[i]], frame.source[i]) <= lasting_error(frame, i) &&
         !is_exact(frame.source[i]);
}

int Compactor::most_error(const IndexedFrame& frame, std::size_t i, int tolerance) const {
  // Smooth areas get less tolerance: all of it would show as streaks.
  const int allowed = std::min(tolerance, 2 + tolerance / 16 + frame.contrast[i]);
  const int most = 9 * allowed * allowed;
  return late_[i] ? std::min(most, lasting_error(frame, i)) : most;
}

Compactor::Pixel Compactor::pixel(const IndexedFrame& frame, std::size_t i, int tolerance) const {
  const std::uint8_t index = frame.index[i], shown = shown_[i];
  Pixel p{index == shown ? std::uint8_t{Palette::transparent} : index, shown, 0, frame.source[i]};
  if (frame.moved[i]) {
    if (tolerance > 0 && !is_exact(p.source))
      p.most_error = static_cast<std::uint16_t>(most_error(frame, i, tolerance));
  } else if (index != shown && may_stay(frame, i)) {
    p.symbol = Palette::transparent;
  }
  return p;
}

/// Finds the rectangle of all changes.
Patch Compactor::changed(const IndexedFrame& frame) const {
  Span rows, columns;
  for (int y = 0; y < height_; ++y) {
    // Pixels that were slightly wrong in the previous frame are corrected now.
    Span span = touched_[static_cast<std::size_t>(y)];
    span.include(frame.touched[static_cast<std::size_t>(y)]);
    const auto stays = [&](int x) {
      const std::size_t i = frame.at(x, y);
      return frame.index[i] == shown_[i] || (!frame.moved[i] && may_stay(frame, i));
    };
    while (span.begin < span.end && stays(span.begin)) ++span.begin;
    if (span.begin >= span.end) continue;
    while (stays(span.end - 1)) --span.end;
    columns.include(span);
    rows.include({y, y + 1});
  }
  if (rows.begin >= rows.end) return {};
  return {columns.begin, rows.begin, columns.end - columns.begin, rows.end - rows.begin, {}};
}

/// Returns the error of a symbol in place of a pixel's own; exceeds the allowed error if it is impossible.
int Compactor::error(const Pixel& pixel, int symbol) const {
  const int index = symbol == Palette::transparent ? pixel.shown : symbol;
  const int own = pixel.symbol == Palette::transparent ? pixel.shown : pixel.symbol;
  if (index == own) return 0;
  if (pixel.most_error == 0 || index == Palette::transparent) return pixel.most_error + 1;
  return color_error(palette_.colors[index], pixel.source);
}

/// Returns the entries that extend one by a pixel's own colour, the newest first: there may be one with the colour's
/// index, and one that keeps the colour shown.
std::array<int, 2> Compactor::exact_children(const Pixel& pixel, int entry) const {
  const int own = pixel.symbol == Palette::transparent ? pixel.shown : pixel.symbol;
  const int drawn = dictionary_.child(entry, own);
  const int kept = pixel.shown == own ? dictionary_.child(entry, Palette::transparent) : LzwDictionary::none;
  return {std::max(drawn, kept), std::min(drawn, kept)};
}

/// Extends a match of the first pixels as far as the dictionary has entries for the next ones. Of several ways, the
/// last is followed here and the others by recursion: mostly there is one.
void Compactor::find_longest(std::span<const Pixel> pixels, Match match, Match& best) const {
  while (static_cast<std::size_t>(match.length) < pixels.size()) {
    const Pixel& pixel = pixels[static_cast<std::size_t>(match.length)];
    Match longer{LzwDictionary::none, match.length + 1, 0};
    const auto follow = [&](int entry, int added) {
      if (longer.entry >= 0) find_longest(pixels, longer, best);
      longer.entry = entry;
      longer.error = match.error + added;
    };
    if (pixel.most_error == 0) {
      for (const int e : exact_children(pixel, match.entry)) {
        if (e >= 0) follow(e, 0);
      }
    } else {
      for (int e = dictionary_.first_child(match.entry); e >= 0; e = dictionary_.next_sibling(e)) {
        const int added = error(pixel, dictionary_.symbol(e));
        if (added <= pixel.most_error) follow(e, added);
      }
    }
    if (longer.entry < 0) break;
    match = longer;
  }
  if (match.length > best.length || (match.length == best.length && match.error < best.error)) best = match;
}

std::string Compactor::compress() {
  LzwCodes codes;
  dictionary_.clear();
  for (std::span<Pixel> rest = pixels_; !rest.empty();) {
    Match best;
    find_longest(rest, {rest[0].symbol, 1, 0}, best);
    int entry = best.entry;
    for (int i = best.length - 1; i > 0; --i, entry = dictionary_.parent(entry)) {
      rest[static_cast<std::size_t>(i)].symbol = static_cast<std::uint8_t>(dictionary_.symbol(entry));
    }
    rest = rest.subspan(static_cast<std::size_t>(best.length));
    codes.put(best.entry, dictionary_.size());
    if (rest.empty()) break;
    dictionary_.extend(best.entry, rest[0].symbol);
    if (dictionary_.is_full()) codes.put_clear(), dictionary_.clear();
  }
  return codes.finish();
}

Patch Compactor::compact(const IndexedFrame& frame, int tolerance) {
  Patch patch = changed(frame);
  pixels_.clear();
  for (int y = patch.y; y < patch.y + patch.height; ++y) {
    for (int x = patch.x; x < patch.x + patch.width; ++x) pixels_.push_back(pixel(frame, frame.at(x, y), tolerance));
  }
  patch.data = compress();

  std::fill(late_.begin(), late_.end(), std::uint8_t{0});
  auto p = pixels_.begin();
  for (int y = patch.y; y < patch.y + patch.height; ++y) {
    for (std::size_t i = frame.at(patch.x, y); i < frame.at(patch.x + patch.width, y); ++i, ++p) {
      if (p->symbol != Palette::transparent) shown_[i] = p->symbol;
      late_[i] = p->most_error > 0 && !may_stay(frame, i);
    }
  }
  touched_ = frame.touched;
  return patch;
}

}  // namespace drape::gif
