#pragma once

#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

using Words = std::vector<std::uint64_t>;

/// Words as bytes: those of most significance of all words first, then the next ones, compressed by zlib, after a line
/// that says how many bytes they unpack to.
std::string pack_words(const Words& words);

/// The inverse.
/// @param most how many words there can be: nothing larger is unpacked
/// @throws std::invalid_argument saying what is wrong with the bytes
Words unpack_words(std::string_view bytes, std::uint64_t most);

/// Writes numbers of all kinds as words.
class WordWriter {
 public:
  /// Small ones of either sign are stored as small ones without: 0, −1, 1, −2, …
  void whole(std::int64_t n) { bits((static_cast<std::uint64_t>(n) << 1) ^ static_cast<std::uint64_t>(n >> 63)); }
  void bits(std::uint64_t n) { words_.push_back(n); }
  void number(double value) { bits(std::bit_cast<std::uint64_t>(value)); }
  [[nodiscard]] const Words& words() const { return words_; }

 private:
  Words words_;
};

/// Reads them again.
/// @throws std::invalid_argument where there is nothing more, or something that cannot be
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
  /// Looks that so many words follow, before anything is made for them.
  void need(std::uint64_t words) const {
    if (words > words_.size() - next_) throw std::invalid_argument("is truncated");
  }
  [[nodiscard]] bool at_end() const { return next_ == words_.size(); }

 private:
  Words words_;
  std::size_t next_ = 0;
};

/// The number, which must be finite. @throws std::invalid_argument if it is not
double finite(double value);

}  // namespace drape
