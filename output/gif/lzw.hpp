#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace drape::gif {

/// The LZW dictionary of a GIF (Welch, "A technique for high-performance data compression", 1984). Entries 0…255 are
/// the symbols; each further entry extends another by a symbol and is linked as its child.
class LzwDictionary {
 public:
  static constexpr int clear_code = 256, end_code = 257;
  static constexpr int none = -1;

  LzwDictionary() { clear(); }

  /// Removes all entries but the symbols.
  void clear();
  /// Must be false before extend().
  [[nodiscard]] bool is_full() const { return size_ == capacity; }
  void extend(int entry, int symbol);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int first_child(int entry) const { return first_child_[entry]; }
  [[nodiscard]] int next_sibling(int entry) const { return next_sibling_[entry]; }
  [[nodiscard]] int parent(int entry) const { return parent_[entry]; }
  [[nodiscard]] int symbol(int entry) const { return symbol_[entry]; }

 private:
  static constexpr int capacity = 4095;  // one less than the number of codes: some decoders count ahead
  std::array<std::int16_t, capacity> first_child_, next_sibling_, parent_;
  std::array<std::uint8_t, capacity> symbol_;
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

}  // namespace drape::gif
