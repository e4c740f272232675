#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/files.hpp"
#include "drape/render/image.hpp"
#include "output/gif/palette.hpp"

namespace drape::gif {

/// Encodes a frame of a film relative to the previous one: lengths of unchanged stretches of bytes, alternating with
/// the bytes that replace others.
///
/// Run lengths are fast. Most of a frame is unchanged and is passed at the speed of memory. Moved parts differ in
/// nearly every byte; compressing them would take longer than writing them to disk.
/// @param packed  result; overwritten
void pack_difference(std::span<const std::uint8_t> before, std::span<const std::uint8_t> now,
                     std::vector<std::uint8_t>& packed);

/// Computes the next frame from the previous one.
/// @returns true if the difference belongs to frames of this size; otherwise the frame's content is undefined
bool apply_difference(std::span<const std::uint8_t> packed, std::span<std::uint8_t> frame);

/// Returns the first position from `begin` where bytes differ; their number if there is none.
std::size_t next_difference(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b, std::size_t begin);

/// Stores the frames of a film on disk, unchanged, to read them again. Holds one frame in memory.
class FrameSpool {
 public:
  /// @param output  destination of the film: the spool lies in its folder, and messages name it
  /// @throws OutputError
  explicit FrameSpool(const PartialFile& output);

  /// @throws OutputError           with the system's reason, such as a full disk
  /// @throws std::invalid_argument if the image has another size than the first one
  void append(const Image& image);

  [[nodiscard]] int count() const { return count_; }

  /// Returns to the first frame. No append() may follow.
  void rewind();

  /// Returns the next frame, valid until the next call. Call it at most count() times after rewind().
  const Image& next();

 private:
  Spool spool_;
  Image last_;                        // the frame that the next one is encoded relative to
  std::vector<std::uint8_t> packed_;  // encoded difference
  int count_ = 0;
};

/// The LZW dictionary of a GIF (Welch, "A technique for high-performance data compression", 1984). Entries 0…255 are
/// the symbols; each further entry extends another by a symbol and is linked as its child.
class LzwDictionary {
 public:
  static constexpr int clear_code = 256, end_code = 257;
  static constexpr int none = -1;
  static constexpr int symbol_bits = 8, code_bits = 12;

  LzwDictionary() { clear(); }

  /// Removes all entries but the symbols.
  void clear();
  /// Must be false before extend().
  [[nodiscard]] bool is_full() const { return size_ == capacity; }
  void extend(int entry, int symbol);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int first_child(int entry) const { return entries_[entry].first_child; }
  [[nodiscard]] int next_sibling(int entry) const { return entries_[entry].next_sibling; }
  /// Returns the child that extends an entry by a symbol; `none` if there is none.
  [[nodiscard]] int child(int entry, int symbol) const {
    if (symbol == 0) return entries_[entry].zero_child;
    if ((entries_[entry].symbols >> symbol % 8 & 1) == 0) return none;
    const auto key = static_cast<std::uint32_t>(entry << symbol_bits | symbol);
    for (std::uint32_t k = slot(key);; k = (k + 1) % slots) {
      if (children_[k] == 0) return none;
      if (children_[k] >> code_bits == key) return static_cast<int>(children_[k] & ((1U << code_bits) - 1));
    }
  }
  [[nodiscard]] int parent(int entry) const { return entries_[entry].parent; }
  [[nodiscard]] int symbol(int entry) const { return entries_[entry].symbol; }

 private:
  static constexpr int capacity = 4095;  // one less than the number of codes: some decoders count ahead
  struct Entry {
    std::int16_t first_child = none, next_sibling = none, parent = none;
    std::int16_t zero_child = none;  // the child of symbol 0: most pixels of a film are transparent
    std::uint8_t symbol = 0;
    std::uint8_t symbols = 0;  // bit k: some child's symbol has the remainder k by 8
  };

  static constexpr std::uint32_t slots = 8192;  // of the hash table: twice the capacity
  /// Returns the first slot for a child.
  static std::uint32_t slot(std::uint32_t key) { return key * 2654435769U >> 19; }

  std::array<Entry, capacity> entries_;
  std::array<std::uint32_t, slots> children_;  // 12 bits of the parent, 8 of the symbol, 12 of the child; 0: free
  int size_ = 0;
};

/// Codes of a picture in GIF's format: 9 to 12 bits, depending on the dictionary's size, the lowest bit first, in
/// blocks of up to 255 bytes that begin with their length.
class LzwCodes {
 public:
  LzwCodes();

  /// @param size  size of the dictionary before this code extends it
  void put(int code, int size);
  /// Makes the decoder remove all entries but the symbols.
  void put_clear();
  /// Ends the picture. @returns its bytes, from the code size to the empty block
  std::string finish();

 private:
  void put_bits(int code);
  void put_byte();

  std::string bytes_;
  std::size_t block_ = 0;  // position of the current block's length
  std::uint32_t bits_ = 0;
  int bit_count_ = 0, width_;
};

/// The changes of a frame relative to the previous one.
struct Patch {
  int x = 0, y = 0, width = 1, height = 1;  ///< bounding rectangle; never empty, as GIF requires
  std::string data;                         ///< compressed pixels
};

/// Compresses a film's frames for GIF. Each frame stores only the rectangle that has changed, in which unchanged pixels
/// are transparent. With a tolerance above 0 it changes pixels slightly to save bytes.
///
/// LZW searches its dictionary for the longest sequence that matches the next pixels. If none continues with a pixel's
/// colour, the compactor accepts a similar colour, as gifsicle's --lossy does. The allowed error depends on the
/// surroundings: it is invisible in a weave where it would show as a streak on a glossy ball.
///
/// Three rules always hold. Pixels unchanged since the previous frame stay, because changes would flicker. Exact
/// colours of the palette stay. No pixel is wrong by more than the dither's error for longer than one frame, because
/// passing cloth would leave traces.
class Compactor {
 public:
  Compactor(const Palette& palette, int width, int height);

  /// @param tolerance  greatest colour error in areas of high contrast: weighted root mean square of the channels, in
  ///                   steps of 1/255; 0: lossless
  Patch compact(const IndexedFrame& frame, int tolerance);

 private:
  /// Data for compressing one pixel.
  struct Pixel {
    std::uint8_t symbol;       // lossless symbol: an index, or the transparent one
    std::uint8_t shown;        // index in the previous frame; the transparent one in the first frame
    std::uint16_t most_error;  // greatest allowed error
    std::uint32_t source;
  };

  /// A path through the dictionary that matches pixels.
  struct Match {
    int entry = 0;
    int length = 0;
    int error = 0;
  };

  [[nodiscard]] Patch changed(const IndexedFrame& frame) const;
  [[nodiscard]] Pixel pixel(const IndexedFrame& frame, std::size_t i, int tolerance) const;
  [[nodiscard]] bool is_exact(std::uint32_t color) const;
  [[nodiscard]] bool may_stay(const IndexedFrame& frame, std::size_t i) const;
  [[nodiscard]] int lasting_error(const IndexedFrame& frame, std::size_t i) const;
  [[nodiscard]] int most_error(const IndexedFrame& frame, std::size_t i, int tolerance) const;
  std::string compress();
  [[nodiscard]] int error(const Pixel& pixel, int symbol) const;
  [[nodiscard]] std::array<int, 2> exact_children(const Pixel& pixel, int entry) const;
  void find_longest(std::span<const Pixel> pixels, Match match, Match& best) const;

  Palette palette_;
  int height_;
  std::vector<std::uint8_t> shown_;  // indices of the previous frame
  std::vector<Span> touched_;        // per row, in the previous frame
  std::vector<std::uint8_t> late_;   // 1: the error in the previous frame must not last
  LzwDictionary dictionary_;
  std::vector<Pixel> pixels_;  // of the patch
};

}  // namespace drape::gif
