#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace drape {

/// Type of a number in a file.
struct NumberType {
  enum class Kind { integer, natural, real };

  Kind kind = Kind::real;
  std::size_t size = 8;     ///< [bytes]: 1, 2, 4 or 8; 4 or 8 for real
  bool big_endian = false;  ///< most significant byte first
};

/// Decodes a number.
/// @param bytes type.size bytes
inline double number_at(const char* bytes, const NumberType& type) {
  char ordered[8] = {};
  std::memcpy(ordered, bytes, type.size);
  if (type.big_endian) std::reverse(ordered, ordered + type.size);
  const auto as = [&](auto number) {
    std::memcpy(&number, ordered, sizeof number);
    return static_cast<double>(number);
  };
  static_assert(std::endian::native == std::endian::little);
  switch (type.kind) {
    case NumberType::Kind::real:
      return type.size == 4 ? as(float{}) : as(double{});
    case NumberType::Kind::integer:
      return type.size == 1   ? as(std::int8_t{})
             : type.size == 2 ? as(std::int16_t{})
             : type.size == 4 ? as(std::int32_t{})
                              : as(std::int64_t{});
    case NumberType::Kind::natural:
      break;
  }
  return type.size == 1   ? as(std::uint8_t{})
         : type.size == 2 ? as(std::uint16_t{})
         : type.size == 4 ? as(std::uint32_t{})
                          : as(std::uint64_t{});
}

/// Decodes consecutive numbers; ignores an incomplete one at the end.
inline std::vector<double> numbers_in(std::string_view bytes, const NumberType& type) {
  std::vector<double> numbers(bytes.size() / type.size);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = number_at(bytes.data() + i * type.size, type);
  return numbers;
}

}  // namespace drape
