#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace drape {

/// The bytes of a file. Besides plain files a pipe is read, up to the limit; devices, which may never end, are not.
/// @param limit the most bytes that it may have
/// @throws UsageError "file: message" if it is not there, a folder or device, longer, or cannot be read
std::string read_file(const std::filesystem::path& file, std::size_t limit);

/// The same for a text in UTF-8, without the byte-order mark that some editors put before it.
/// @throws UsageError also for UTF-16, which such a mark tells, and for what no text has, a zero byte
std::string read_text(const std::filesystem::path& file, std::size_t limit);

/// The same of bytes that have been read from it.
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

  /// Reads from an offset on into `bytes`: up to `most` of them, fewer only at the end of the file.
  /// @throws UsageError if they cannot be read
  void read(std::size_t offset, std::size_t most, std::string& bytes) const;

 private:
  std::filesystem::path file_;
  int descriptor_;
};

}  // namespace drape
