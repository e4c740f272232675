#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/atomic_file.hpp"

namespace drape {

/// Writes a zip archive from front to back, its entries as they are (not deflated), all with the sizes of 64 bits that
/// large ones need (APPNOTE.TXT 6.3, 4.3.14 and 4.5.3), and without the time of day: the same entries give the same
/// bytes.
class ZipWriter {
 public:
  /// @param file empty
  explicit ZipWriter(PartialFile& file) : file_(file) {}

  /// Begins an entry, whose bytes are to be written to the file next.
  /// @param crc32 of those bytes
  void begin(const std::string& name, std::uint64_t size, std::uint32_t crc32);

  /// Writes the directory of the entries, behind the last.
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
  std::uint64_t written_ = 0;  // the entries' own bytes included
};

}  // namespace drape
