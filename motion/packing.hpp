#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

// How a motion file's parts are made into bytes: docs/motion-file.md. All that goes wrong with bytes that are read is a
// std::invalid_argument that completes "the file …".

/// The number of bytes, and then they themselves as a stream of zlib's.
std::string pack(std::string_view bytes);
/// For words whose bytes, laid in planes, are either all alike or noise: much faster, and hardly larger.
std::string pack_planes(const std::vector<std::uint64_t>& words);

/// The inverses. Nothing larger is made than the packed bytes can be, or than there may be.
/// @param most bytes
std::string unpack(std::string_view packed, std::uint64_t most = UINT64_MAX);
/// @param count how many words there must be
std::vector<std::uint64_t> unpack_planes(std::string_view packed, std::size_t count);

/// Numbers as bytes, little endian, one after another.
class ByteWriter {
 public:
  ByteWriter& whole(std::uint64_t number);
  ByteWriter& number(double value);
  ByteWriter& bytes(std::string_view more) { return bytes_ += more, *this; }
  [[nodiscard]] const std::string& text() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads them again.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t whole();
  double number();
  /// All that is left.
  [[nodiscard]] std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
};

}  // namespace drape
