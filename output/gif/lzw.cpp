#include "output/gif/lzw.hpp"

#include <utility>

namespace drape::gif {
namespace {

constexpr int symbol_bits = 8, least_width = symbol_bits + 1, most_width = 12;
constexpr std::size_t most_of_block = 255;

}  // namespace

void LzwDictionary::clear() {
  size_ = end_code + 1;
  first_child_.fill(none);
}

void LzwDictionary::extend(int entry, int symbol) {
  symbol_[size_] = static_cast<std::uint8_t>(symbol);
  parent_[size_] = static_cast<std::int16_t>(entry);
  next_sibling_[size_] = first_child_[entry];
  first_child_[entry] = static_cast<std::int16_t>(size_);
  ++size_;
}

LzwCodes::LzwCodes() : bytes_{static_cast<char>(symbol_bits), '\0'}, block_(1), width_(least_width) { put_clear(); }

void LzwCodes::put_byte() {
  if (bytes_.size() - block_ > most_of_block) {
    bytes_[block_] = static_cast<char>(most_of_block);
    block_ = bytes_.size();
    bytes_.push_back('\0');
  }
  bytes_.push_back(static_cast<char>(bits_ & 0xff));
  bits_ >>= 8;
  bit_count_ -= 8;
}

void LzwCodes::put_bits(int code) {
  bits_ |= static_cast<std::uint32_t>(code) << bit_count_;
  for (bit_count_ += width_; bit_count_ >= 8;) put_byte();
}

void LzwCodes::put(int code, int size) {
  put_bits(code);
  if (size == 1 << width_ && width_ < most_width) ++width_;
}

void LzwCodes::put_clear() {
  put_bits(LzwDictionary::clear_code);
  width_ = least_width;
}

std::string LzwCodes::finish() {
  put_bits(LzwDictionary::end_code);
  if (bit_count_ > 0) put_byte();
  bytes_[block_] = static_cast<char>(bytes_.size() - block_ - 1);
  if (bytes_[block_] != '\0') bytes_.push_back('\0');
  return std::move(bytes_);
}

}  // namespace drape::gif
