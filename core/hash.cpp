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

}  // namespace drape
