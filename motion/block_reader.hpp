#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "motion/descriptor.hpp"

namespace drape {

struct Block {
  std::string tag, payload;
  std::uint64_t end = 0;  ///< start of the next block
};

/// Random-access reader of a file of blocks; it validates all bytes. Errors are UsageErrors that name the file.
class BlockReader {
 public:
  /// @param magic  first line of the file; its last word is the version: "drape recorded motion 1\n"
  /// @param what   kind of file for messages: "motion"
  /// @param limit  number of valid bytes of the file
  BlockReader(std::filesystem::path file, const std::string& magic, const std::string& what,
              std::uint64_t limit = UINT64_MAX);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Reads the block at an offset and verifies its checksum.
  [[nodiscard]] Block block(std::uint64_t begin) const;
  /// Reads tag, first bytes and end of a block without the rest of it.
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
