#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "motion/descriptor.hpp"

namespace drape {

/// What every block begins with: tag, size of the payload, and a checksum of both and the payload.
std::string block_head(std::string_view tag, std::string_view payload);

/// Removes a file of blocks. @throws UsageError if another process is writing it
void remove_unless_written(const std::filesystem::path& file);

/// A file of blocks that grows, visibly, and is locked while it does.
class BlockWriter {
 public:
  /// Makes a new file. @throws UsageError if it is there; OutputError if it cannot be made
  BlockWriter(std::filesystem::path file, std::string_view magic);
  /// Goes on after the first `size` bytes of a file; what is after them goes.
  /// @throws UsageError if another process is writing it; OutputError if it cannot be written
  BlockWriter(std::filesystem::path file, std::uint64_t size);

  /// Appends a block. @returns where it begins @throws OutputError
  std::uint64_t add(std::string_view tag, std::string_view payload);
  /// Appends bytes. @throws OutputError
  void write(std::string_view bytes);
  /// Waits until all is on the disk. @throws OutputError
  void sync();
  /// Gives the file another name when all of it is on the disk. Nothing can be added then. @throws OutputError
  void complete_as(const std::filesystem::path& name);

  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path file_;
  Descriptor descriptor_;
  std::uint64_t size_ = 0;
};

}  // namespace drape
