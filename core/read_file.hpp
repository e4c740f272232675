#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace drape {

/// Reads all bytes of a file or, up to the limit, of a pipe. Refuses devices, which may never end.
/// @param limit greatest size [bytes]
/// @throws UsageError "file: message" if it is not there, a folder or device, longer, or cannot be read
std::string read_file(const std::filesystem::path& file, std::size_t limit);

/// Reads a text in UTF-8, without the byte-order mark that some editors write.
/// @throws UsageError also for UTF-16, recognised by its byte-order mark, and for binary files, by a zero byte
std::string read_text(const std::filesystem::path& file, std::size_t limit);

/// Checks and returns the text in bytes that were read from a file, as read_text().
std::string text_of(const std::filesystem::path& file, std::string text);

/// A file that is read a piece at a time.
class FilePieces {
 public:
  /// @throws UsageError as read_file()
  explicit FilePieces(const std::filesystem::path& file);
  ~FilePieces();
  FilePieces(const FilePieces&) = delete;
  FilePieces& operator=(const FilePieces&) = delete;

  /// Returns true for a plain file, whose pieces can be read in any order. A pipe has to be read whole.
  static bool possible(const std::filesystem::path& file);

  /// Reads up to `most` bytes from an offset into `bytes`, fewer only at the end of the file.
  /// @throws UsageError if they cannot be read
  void read(std::size_t offset, std::size_t most, std::string& bytes) const;

 private:
  std::filesystem::path file_;
  int descriptor_;
};

}  // namespace drape
