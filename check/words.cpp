#include "check/words.hpp"

#include <zlib.h>

#include <cmath>
#include <new>

#include "core/byte_planes.hpp"

namespace drape {

std::string pack_words(const Words& words) {
  const std::string planes = byte_planes(words);
  uLongf size = compressBound(planes.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(planes.data()),
                planes.size(), Z_BEST_COMPRESSION) != Z_OK) {
    throw std::bad_alloc();
  }
  packed.resize(size);
  return std::to_string(planes.size()) + "\n" + packed;
}

Words unpack_words(std::string_view bytes, std::uint64_t most) {
  const std::size_t line = bytes.find('\n');
  std::size_t size = 0;
  for (const char c : bytes.substr(0, line)) {
    if (c < '0' || c > '9' || size > (std::size_t{1} << 40))
      throw std::invalid_argument("has a size that cannot be read");
    size = 10 * size + static_cast<std::size_t>(c - '0');
  }
  // The compression ratio of zlib is below 1100: reserve no more for a damaged file.
  if (line == std::string_view::npos || size % 8 != 0 || size / 1100 > bytes.size()) {
    throw std::invalid_argument("is truncated");
  }
  if (size / 8 > most) throw std::invalid_argument("holds more than its manifest allows");
  bytes.remove_prefix(line + 1);
  std::string planes(size, '\0');
  uLongf unpacked = size;
  uLong used = bytes.size();
  if (uncompress2(reinterpret_cast<Bytef*>(planes.data()), &unpacked, reinterpret_cast<const Bytef*>(bytes.data()),
                  &used) != Z_OK ||
      unpacked != size || used != bytes.size()) {
    throw std::invalid_argument("is damaged");
  }
  return from_byte_planes(planes);
}

double WordReader::number() { return finite(std::bit_cast<double>(bits())); }

double finite(double value) {
  if (!std::isfinite(value)) throw std::invalid_argument("contains a number that is not finite");
  return value;
}

}  // namespace drape
