#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace drape {

/// A hash of bytes, 64 bits (FNV-1a of Fowler, Noll and Vo): tells different data apart, but does not withstand someone
/// who wants to make two of the same hash.
class Hash {
 public:
  void add(const void* bytes, std::size_t count);
  void add(std::string_view text) { add(text.data(), text.size()); }

  [[nodiscard]] std::uint64_t value() const { return value_; }
  /// 16 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

/// Hash of some bytes as text: 16 hexadecimal digits.
std::string checksum_of(std::string_view bytes);

}  // namespace drape
