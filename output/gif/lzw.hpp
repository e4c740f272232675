#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace drape::gif {

/// The dictionary that the compression of a GIF builds up (Welch, "A technique for high-performance data compression",
/// 1984): the entries 0…255 are the symbols, each further one extends an entry by a symbol. The entries with which one
/// goes on are linked as children of it.
class LzwDictionary {
 public:
  static constexpr int clear_code = 256, end_code = 257;
  static constexpr int none = -1;

  LzwDictionary() { clear(); }

  /// Forgets all but the symbols.
  void clear();
  /// To be asked before extend().
  [[nodiscard]] bool is_full() const { return size_ == capacity; }
  void extend(int entry, int symbol);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int first_child(int entry) const { return first_child_[entry]; }
  [[nodiscard]] int next_sibling(int entry) const { return next_sibling_[entry]; }
  [[nodiscard]] int parent(int entry) const { return parent_[entry]; }
  [[nodiscard]] int symbol(int entry) const { return symbol_[entry]; }

 private:
  static constexpr int capacity = 4095;  // one less than there are codes: some decoders count ahead
  std::array<std::int16_t, capacity> first_child_, next_sibling_, parent_;
  std::array<std::uint8_t, capacity> symbol_;
  int size_ = 0;
};

/// The codes of a picture as a GIF stores them: of 9 to 12 bits, as many as the dictionary's size calls for, the lowest
/// bit first, in blocks of up to 255 bytes that begin with their length.
class LzwCodes {
 public:
  LzwCodes();

  /// @param size  of the dictionary before it is extended because of this code
  void put(int code, int size);
  /// Tells the decoder to forget all but the symbols.
  void put_clear();
  /// Ends the picture. @returns its bytes, from the code size to the empty block
  std::string finish();

 private:
  void put_bits(int code);
  void put_byte();

  std::string bytes_;
  std::size_t block_ = 0;  // where the present block's length is
  std::uint32_t bits_ = 0;
  int bit_count_ = 0, width_;
};

}  // namespace drape::gif
