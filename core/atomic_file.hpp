#pragma once

#include <cstdint>
#include <filesystem>
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
  /// not delete it.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

  /// Appends bytes. @throws OutputError with the system's reason
  void write(std::string_view bytes);

  /// Overwrites existing bytes. @throws OutputError with the system's reason
  void overwrite(std::uint64_t offset, std::string_view bytes);

  /// Replaces the content by another file of the same folder, which moves here. @throws OutputError
  void adopt(const std::filesystem::path& other);

  /// Checks that a further MiB can be written, for libraries that fail without a reason. Destroys the content.
  /// @throws OutputError
  void require_space();

  /// Flushes the bytes to disk and renames the file: to file(), or to partial_name() of it if it ended early.
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

/// Writes all bytes to an open file. @returns 0 or the error number
int write_all(int descriptor, std::string_view bytes);

/// Makes new names in a folder survive a power cut; does nothing on file systems that cannot.
void sync_folder(const std::filesystem::path& folder);

/// Checks now that a file can be written later, after hours of work. Leaves nothing behind.
/// @throws OutputError as PartialFile
void require_writable(const std::filesystem::path& file);

/// Writes a whole file, or changes nothing. @returns its size [bytes] @throws OutputError as PartialFile
std::uintmax_t write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

}  // namespace drape
