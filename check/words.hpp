#pragma once

#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

using Words = std::vector<std::uint64_t>;

/// Serialises words: the most significant bytes of all words first, then the next ones, compressed by zlib. A line with
/// the unpacked size comes first.
std::string pack_words(const Words& words);

/// Reads these bytes.
/// @param most largest number of words; larger data are rejected before decompression
/// @throws std::invalid_argument that describes the error in the bytes
Words unpack_words(std::string_view bytes, std::uint64_t most);

/// Writer of numbers as words.
class WordWriter {
 public:
  /// Writes a number in zigzag encoding, which maps 0, −1, 1, −2, … to small unsigned numbers.
  void whole(std::int64_t n) { bits((static_cast<std::uint64_t>(n) << 1) ^ static_cast<std::uint64_t>(n >> 63)); }
  void bits(std::uint64_t n) { words_.push_back(n); }
  void number(double value) { bits(std::bit_cast<std::uint64_t>(value)); }
  [[nodiscard]] const Words& words() const { return words_; }

 private:
  Words words_;
};

/// Reader of words.
/// @throws std::invalid_argument at the end of the data, or for an invalid number
class WordReader {
 public:
  explicit WordReader(Words words) : words_(std::move(words)) {}

  std::uint64_t bits() {
    need(1);
    return words_[next_++];
  }
  std::int64_t whole() {
    const std::uint64_t n = bits();
    return static_cast<std::int64_t>(n >> 1) ^ -static_cast<std::int64_t>(n & 1);
  }
  std::int64_t whole(std::int64_t least, std::int64_t most) {
    const std::int64_t n = whole();
    if (n < least || n > most) throw std::invalid_argument("holds a number that makes no sense");
    return n;
  }
  double number();
  /// Checks that enough words follow, before memory is allocated for them.
  void need(std::uint64_t words) const {
    if (words > words_.size() - next_) throw std::invalid_argument("is truncated");
  }
  [[nodiscard]] bool at_end() const { return next_ == words_.size(); }

 private:
  Words words_;
  std::size_t next_ = 0;
};

/// Returns the number if it is finite. @throws std::invalid_argument otherwise
double finite(double value);

}  // namespace drape
