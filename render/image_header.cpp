#include "render/image_header.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace drape {
namespace {

using Bytes = std::span<const unsigned char>;

/// Reads a whole number of `count` bytes, big-endian.
int number_at(Bytes bytes, std::size_t offset, std::size_t count) {
  int number = 0;
  for (const unsigned char byte : bytes.subspan(offset, count)) number = number << 8 | byte;
  return number;
}

/// Reads an 8-byte signature, then the chunk IHDR (length, name, width, height, …).
std::optional<ImageSize> size_of_png(Bytes bytes) {
  constexpr std::size_t width = 16, height = 20, end = 24;
  if (bytes.size() < end || bytes[width] > 0x7F || bytes[height] > 0x7F) return std::nullopt;
  return ImageSize{number_at(bytes, width, 4), number_at(bytes, height, 4)};
}

/// Reads segments: a marker (FF and a code), a length that excludes the marker, and contents. The start of frame (SOF0
/// to SOF15, except the numbers of DHT, JPG and DAC) holds precision, height, width, …
std::optional<ImageSize> size_of_jpeg(Bytes bytes) {
  constexpr std::array not_frames{0xC4, 0xC8, 0xCC};
  for (std::size_t at = 2; at + 9 <= bytes.size() && bytes[at] == 0xFF;) {
    const int code = bytes[at + 1];
    if (code == 0xFF) {  // padding
      ++at;
    } else if (code >= 0xC0 && code <= 0xCF && std::ranges::find(not_frames, code) == not_frames.end()) {
      return ImageSize{number_at(bytes, at + 7, 2), number_at(bytes, at + 5, 2)};
    } else {
      at += 2 + static_cast<std::size_t>(number_at(bytes, at + 2, 2));
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<ImageSize> size_in_header(Bytes bytes) {
  constexpr std::array<unsigned char, 4> png{0x89, 'P', 'N', 'G'};
  constexpr std::array<unsigned char, 3> jpeg{0xFF, 0xD8, 0xFF};
  if (bytes.size() < png.size()) return std::nullopt;
  if (std::equal(png.begin(), png.end(), bytes.begin())) return size_of_png(bytes);
  if (std::equal(jpeg.begin(), jpeg.end(), bytes.begin())) return size_of_jpeg(bytes);
  return std::nullopt;
}

}  // namespace drape
