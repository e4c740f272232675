#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "motion/descriptor.hpp"

namespace drape {

struct Block {
  std::string tag, payload;
  std::uint64_t end = 0;  ///< where the next one begins
};

/// Reads files of blocks, from a place on. Takes nothing for granted: what is wrong with a file is a UsageError that
/// names it.
class BlockReader {
 public:
  /// @param magic  what the file must begin with, a line whose last word is the version: "drape recorded motion 1\n"
  /// @param what   it must be, for messages: "motion"
  /// @param limit  how much of the file counts
  BlockReader(std::filesystem::path file, const std::string& magic, const std::string& what,
              std::uint64_t limit = UINT64_MAX);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// The block at a place, whose checksum is right.
  [[nodiscard]] Block block(std::uint64_t begin) const;
  /// Its tag, first bytes and end, without reading the rest of it.
  [[nodiscard]] Block first_bytes(std::uint64_t begin, std::uint64_t count) const;
  [[nodiscard]] std::string bytes(std::uint64_t begin, std::uint64_t count) const;

  /// @throws UsageError "file: message"
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::filesystem::path file_;
  Descriptor descriptor_;
  std::uint64_t size_ = 0;
};

}  // namespace drape
