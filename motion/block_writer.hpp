#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "motion/descriptor.hpp"

namespace drape {

/// Returns the header of a block: tag, payload size, and a checksum of both and the payload.
std::string block_head(std::string_view tag, std::string_view payload);

/// Removes a file of blocks. @throws UsageError if another process is writing it
void remove_unless_written(const std::filesystem::path& file);

/// A growing file of blocks, visible under its name and locked while open.
class BlockWriter {
 public:
  /// Creates a file. @throws UsageError if it exists; OutputError if it cannot be created
  BlockWriter(std::filesystem::path file, std::string_view magic);
  /// Appends after the first `size` bytes of a file and discards the rest.
  /// @throws UsageError if another process is writing it; OutputError if it cannot be written
  BlockWriter(std::filesystem::path file, std::uint64_t size);

  /// Appends a block. @returns its offset @throws OutputError
  std::uint64_t add(std::string_view tag, std::string_view payload);
  /// Appends bytes. @throws OutputError
  void write(std::string_view bytes);
  /// Waits until all bytes are on disk. @throws OutputError
  void sync();
  /// Syncs the file and renames it; nothing can be added afterwards. @throws OutputError
  void complete_as(const std::filesystem::path& name);

  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path file_;
  Descriptor descriptor_;
  std::uint64_t size_ = 0;
};

}  // namespace drape
