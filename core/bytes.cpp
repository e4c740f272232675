#include "core/bytes.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace drape {
namespace {

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Returns the value of a digit; −1 for any other character.
int value_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

}  // namespace

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

std::string base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::optional<std::string> from_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') {  // end of a part: start again
      bits = 0;
      count = 0;
      continue;
    }
    const int value = value_of(c);
    if (value < 0) {
      if (std::string_view(" \t\r\n").find(c) != std::string_view::npos) continue;
      return std::nullopt;
    }
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

}  // namespace drape
