#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

// Encoding of a motion file's parts as bytes, see docs/motion-file.md. Invalid bytes throw a std::invalid_argument
// whose text completes "the file …".

/// Compresses bytes: their number, followed by a zlib stream.
std::string pack(std::string_view bytes);
/// Compresses words whose byte planes are either constant or noise: much faster, and hardly larger.
std::string pack_planes(const std::vector<std::uint64_t>& words);

/// Decompresses bytes. Memory is limited by the packed size and by `most`.
/// @param most largest number of bytes
std::string unpack(std::string_view packed, std::uint64_t most = UINT64_MAX);
/// Decompresses exactly `count` words.
std::vector<std::uint64_t> unpack_planes(std::string_view packed, std::size_t count);

/// Writer of numbers as bytes, little endian, one after another.
class ByteWriter {
 public:
  ByteWriter& whole(std::uint64_t number);
  ByteWriter& number(double value);
  ByteWriter& bytes(std::string_view more) { return bytes_ += more, *this; }
  [[nodiscard]] const std::string& text() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reader of such numbers.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t whole();
  double number();
  /// Returns all remaining bytes.
  [[nodiscard]] std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
};

}  // namespace drape
