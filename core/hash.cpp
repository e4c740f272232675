#include "core/hash.hpp"

#include <fmt/format.h>

namespace drape {

void Hash::add(const void* bytes, std::size_t count) {
  constexpr std::uint64_t prime = 0x100000001b3;
  const auto* byte = static_cast<const unsigned char*>(bytes);
  for (std::size_t i = 0; i < count; ++i) value_ = (value_ ^ byte[i]) * prime;
}

std::string Hash::text() const { return fmt::format("{:016x}", value_); }

std::string checksum_of(std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  return hash.text();
}

std::string byte_planes(const std::vector<std::uint64_t>& words) {
  std::string bytes(8 * words.size(), '\0');
  for (std::size_t plane = 0; plane < 8; ++plane) {
    char* to = bytes.data() + plane * words.size();
    for (const std::uint64_t word : words) *to++ = static_cast<char>(word >> (56 - 8 * plane) & 255);
  }
  return bytes;
}

std::vector<std::uint64_t> from_byte_planes(std::string_view bytes) {
  std::vector<std::uint64_t> words(bytes.size() / 8, 0);
  for (std::size_t plane = 0; plane < 8; ++plane) {
    const char* from = bytes.data() + plane * words.size();
    for (std::uint64_t& word : words) word = word << 8 | static_cast<unsigned char>(*from++);
  }
  return words;
}

}  // namespace drape
