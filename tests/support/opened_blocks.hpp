#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/bytes.hpp"
#include "motion/blocks.hpp"
#include "motion/encoding.hpp"

namespace drape::test {

/// An unpacked block of a motion file or a checkpoint.
struct OpenedBlock {
  std::string tag;
  std::string head;   ///< unpacked part of the file
  std::string plain;  ///< the rest, decompressed
  bool changed = false;

  [[nodiscard]] std::string payload() const {
    if (tag == "SIZE") return plain;
    const bool planes = (tag == state_tag || tag == rows_tag) && plain.size() % 8 == 0;
    return head + (planes ? pack_planes(from_byte_planes(plain)) : pack(plain));
  }

  /// Returns the words stored as byte planes.
  [[nodiscard]] std::vector<std::uint64_t> words() const { return from_byte_planes(plain); }
  void set_words(const std::vector<std::uint64_t>& words) { plain = byte_planes(words); }
};

/// A motion file or a checkpoint with editable parts. sealed() restores sizes and checksums, and an index that was not
/// edited itself leads to the blocks.
class OpenedBlocks {
 public:
  /// @param bytes content of an intact file
  explicit OpenedBlocks(std::string_view bytes) : magic_(bytes.substr(0, bytes.find('\n') + 1)) {
    constexpr std::size_t block_head_size = 16, end_size = 16;
    complete_ = bytes.ends_with(motion_end);
    const std::string_view all = bytes.substr(0, bytes.size() - (complete_ ? end_size : 0));
    for (std::size_t at = magic_.size(); at < all.size();) {
      const std::uint64_t size = ByteReader(all.substr(at + 4)).whole();
      blocks.push_back(opened(std::string(all.substr(at, 4)), all.substr(at + block_head_size, size)));
      at += block_head_size + size;
    }
  }

  /// Flips bits of one byte, in a block's head or in its decompressed rest.
  void change(std::size_t block, std::size_t place, std::uint8_t bits) {
    OpenedBlock& of = blocks[block % blocks.size()];
    const std::size_t size = of.head.size() + of.plain.size();
    if (size == 0) return;
    place %= size;
    char& byte = place < of.head.size() ? of.head[place] : of.plain[place - of.head.size()];
    byte = static_cast<char>(static_cast<std::uint8_t>(byte) ^ bits);
    of.changed = true;
  }

  /// Returns the k-th block with a tag.
  OpenedBlock& block(std::string_view tag, std::size_t k = 0) {
    for (OpenedBlock& block : blocks) {
      if (block.tag == tag && k-- == 0) return block;
    }
    throw std::out_of_range("there is no such block");
  }

  [[nodiscard]] std::string sealed() const {
    std::string bytes = magic_;
    ByteWriter states, rows;
    std::uint64_t state_count = 0, rows_count = 0, index = 0;
    for (const OpenedBlock& block : blocks) {
      std::string payload = block.payload();
      const bool state = block.tag == state_tag;
      if (state || block.tag == rows_tag) {
        (state ? states : rows).bytes(std::string_view(payload).substr(0, 8)).whole(bytes.size());
        ++(state ? state_count : rows_count);
      } else if (block.tag == index_tag) {
        index = bytes.size();
        if (!block.changed) {
          payload =
              pack(ByteWriter().whole(state_count).whole(rows_count).bytes(states.text()).bytes(rows.text()).text());
        }
      }
      bytes += block_head(block.tag, payload) + payload;
    }
    return complete_ ? bytes + ByteWriter().whole(index).bytes(motion_end).text() : bytes;
  }

  std::vector<OpenedBlock> blocks;

 private:
  static OpenedBlock opened(std::string tag, std::string_view payload) {
    if (tag == "SIZE") return {std::move(tag), {}, std::string(payload)};
    const std::size_t head = tag == state_tag || tag == rows_tag ? 16 : 0;
    return {std::move(tag), std::string(payload.substr(0, head)), unpack(payload.substr(head))};
  }

  std::string magic_;
  bool complete_ = false;
};

}  // namespace drape::test
