#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/atomic_file.hpp"

namespace drape {

/// Writes a zip archive from front to back: entries stored without compression, with 64-bit sizes for large ones
/// (APPNOTE.TXT 6.3, 4.3.14 and 4.5.3), and without time stamps, so that the same entries give the same bytes.
class ZipWriter {
 public:
  /// @param file must be empty
  explicit ZipWriter(PartialFile& file) : file_(file) {}

  /// Begins an entry; write its bytes to the file next.
  /// @param crc32 checksum of those bytes
  void begin(const std::string& name, std::uint64_t size, std::uint32_t crc32);

  /// Writes the directory after the last entry.
  void finish();

 private:
  struct Entry {
    std::string name;
    std::uint64_t size, offset;
    std::uint32_t crc32;
  };
  void write(std::string_view bytes);

  PartialFile& file_;
  std::vector<Entry> entries_;
  std::uint64_t written_ = 0;  // includes the bytes of the entries
};

}  // namespace drape
