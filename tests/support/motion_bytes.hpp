#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <vector>

namespace drape::test {

/// A motion.bin of any words, which pack_motion() need not be able to make.
inline std::string motion_bytes(const std::vector<std::uint64_t>& words) {
  std::string planes;
  for (int shift = 56; shift >= 0; shift -= 8) {
    for (const std::uint64_t word : words) planes += static_cast<char>(word >> shift & 255);
  }
  uLongf size = compressBound(planes.size());
  std::string packed(size, '\0');
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(planes.data()),
            planes.size(), Z_BEST_SPEED);
  return "drape motion 1\n" + std::to_string(planes.size()) + "\n" + packed.substr(0, size);
}

}  // namespace drape::test
