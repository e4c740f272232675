#pragma once

// Hashes of bytes, and their encodings: base64 and byte planes.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// A 64-bit hash of bytes (FNV-1a of Fowler, Noll and Vo). It detects different data, but is not secure against forged
/// collisions.
class Hash {
 public:
  void add(const void* bytes, std::size_t count);
  void add(std::string_view text) { add(text.data(), text.size()); }

  [[nodiscard]] std::uint64_t value() const { return value_; }
  /// Returns 16 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

/// Hashes bytes and returns 16 hexadecimal digits.
std::string checksum_of(std::string_view bytes);

/// Hashes the bits of consecutive numbers and returns 16 hexadecimal digits.
template <class Number>
std::string checksum_of(const Number* numbers, std::size_t count) {
  Hash hash;
  hash.add(numbers, count * sizeof(Number));
  return hash.text();
}

/// Splits words into byte planes: the most significant bytes of all words, then the next ones. Similar bytes become
/// neighbours, so the result compresses well.
std::string byte_planes(const std::vector<std::uint64_t>& words);

/// Inverts byte_planes(). Ignores a remainder of size() modulo 8.
std::vector<std::uint64_t> from_byte_planes(std::string_view bytes);

/// Encodes bytes as base64 (RFC 4648, section 4).
std::string base64(std::string_view bytes);

/// Decodes base64 that may contain white space. Several encoded parts, each ended by its padding, may follow each
/// other.
/// @returns nothing if there is another character
std::optional<std::string> from_base64(std::string_view text);

}  // namespace drape
