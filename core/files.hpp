#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace drape {

/// Result of writing a file: complete, or ended early with only the part written so far.
enum class Ending { complete, early };

/// Returns "out/NAME.partial.EXT", the name of a file that ended early, beside the complete one.
std::filesystem::path partial_name(const std::filesystem::path& file);

/// A file that appears under its name only when it is complete.
///
/// The bytes go to a hidden file in the same folder, ".NAME.partial-N.EXT", which commit() renames to the final name.
/// An existing file stays unchanged until then, and without a commit nothing is left behind. A symbolic link stays: the
/// file that it points to is replaced. The new file has the permissions of the replaced one.
///
/// The hidden file is locked (flock) while it is written. An unlocked one is left over from a killed process; the next
/// writer to the same name removes it.
class PartialFile {
 public:
  /// Creates the missing folders and the temporary file, so that an error is known at once.
  /// @param file  final file; messages name it as given here
  /// @throws OutputError if it is a folder or a device, is write-protected, or its folder cannot be written to
  explicit PartialFile(const std::filesystem::path& file);
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

  /// Returns the absolute temporary path, with the final extension, for libraries that open files by name. They must
  /// not delete the file.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

  /// Appends bytes.
  /// @throws OutputError with the system's reason
  void write(std::string_view bytes);

  /// Overwrites existing bytes.
  /// @throws OutputError with the system's reason
  void overwrite(std::uint64_t offset, std::string_view bytes);

  /// Replaces the content by another file of the same folder, which moves here.
  /// @throws OutputError
  void adopt(const std::filesystem::path& other);

  /// Checks that a further MiB can be written, for libraries that fail without a reason. Destroys the content.
  /// @throws OutputError
  void require_space();

  /// Flushes the bytes to disk and renames the file to file(), or to its partial_name() if it ended early.
  /// @returns its size [bytes]
  /// @throws OutputError
  std::uintmax_t commit(Ending ending = Ending::complete);

  /// Returns the name that commit() gives the file.
  [[nodiscard]] std::filesystem::path name(Ending ending) const;

 private:
  void open_temporary();
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path file_, partial_, target_, temporary_;
  int descriptor_ = -1;
};

/// Writes all bytes to an open file.
/// @returns 0 or the error number
int write_all(int descriptor, std::string_view bytes);

/// Makes new names in a folder survive a power cut; does nothing on file systems that cannot.
void sync_folder(const std::filesystem::path& folder);

/// Checks now that a file can be written later, after hours of work. Leaves nothing behind.
/// @throws OutputError as PartialFile
void require_writable(const std::filesystem::path& file);

/// Writes a whole file, or changes nothing.
/// @returns its size [bytes]
/// @throws OutputError as PartialFile
std::uintmax_t write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

/// Reads all bytes of a file or, up to the limit, of a pipe. Refuses devices, which may never end.
/// @param limit greatest size [bytes]
/// @throws UsageError "file: message" if the file is missing, a folder or device, too long, or unreadable
std::string read_file(const std::filesystem::path& file, std::size_t limit);

/// Reads a text in UTF-8, without the byte-order mark that some editors write.
/// @throws UsageError also for UTF-16, recognised by its byte-order mark, and for binary files, by a zero byte
std::string read_text(const std::filesystem::path& file, std::size_t limit);

/// Checks bytes that were read from a file and returns their text, like read_text().
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
  /// @throws UsageError if the bytes cannot be read
  void read(std::size_t offset, std::size_t most, std::string& bytes) const;

 private:
  std::filesystem::path file_;
  int descriptor_;
};

/// Returns the absolute path at the end of a chain of symbolic links, which need not exist.
/// @throws std::filesystem::filesystem_error if the chain has no end or cannot be followed
std::filesystem::path link_target(const std::filesystem::path& file);

/// Returns a key that is the same for all paths to one file, through ".", "..", symbolic links or hard links. The file
/// need not exist. Two missing files whose names differ only in the case of letters count as different.
std::string file_identity(const std::filesystem::path& file);

/// A private folder among the system's temporary files; removed by the destructor.
///
/// It is locked (flock) while it is in use. An unlocked one is left over from a killed process; creating the next
/// folder of its kind removes it.
class TemporaryFolder {
 public:
  /// @param kind beginning of its name: "drape-scene"
  /// @throws OutputError
  explicit TemporaryFolder(const std::string& kind);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Bytes kept on disk until they can be written to their destination. The file has no name, so that nothing remains of
/// it even if the process is killed.
class Spool {
 public:
  /// @param output destination of the bytes: the spool lies in its folder, and messages name it
  /// @param kept   name of the bytes: "its frames"
  /// @throws OutputError
  Spool(const PartialFile& output, std::string kept);

  /// Keeps bytes without a destination in the system's folder for temporary files.
  /// @param kept name of the bytes: "the motion"
  /// @throws OutputError
  explicit Spool(std::string kept);

  /// Appends bytes.
  /// @throws OutputError with the system's reason, such as a full disk
  void append(std::string_view bytes);

  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Returns to the first byte, any number of times. No append() may follow.
  void rewind();

  /// Reads the next bytes; `count` must not exceed the rest.
  void read(void* bytes, std::size_t count);

  /// Writes all bytes to a file.
  void copy_to(PartialFile& file);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[noreturn]] void fail(int error_number) const;

  void open(const std::filesystem::path& folder);

  std::string problem_;  // beginning of a message, before the system's reason
  std::unique_ptr<std::FILE, Close> stream_;
  std::uint64_t size_ = 0;
};

}  // namespace drape
