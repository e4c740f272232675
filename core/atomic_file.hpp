#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace drape {

/// How the making of a file ended: it holds what was asked for, or what there was when the work ended early.
enum class Ending { complete, early };

/// "out/NAME.partial.EXT": where a file that ended early appears, beside the complete one.
std::filesystem::path partial_name(const std::filesystem::path& file);

/// A file that appears under its name only when it is complete.
///
/// The bytes go to a hidden file in the same folder, ".NAME.partial-N.EXT", which commit() renames over the final one.
/// Until then an existing file stays as it is, and without a commit nothing is left behind. Of a symbolic link, the
/// file it points to is replaced. A replaced file's permissions are kept.
///
/// The hidden file is locked (flock) for as long as it is being written. One that is not was left by a process that was
/// killed; the next one that writes to the same name removes it.
class PartialFile {
 public:
  /// Creates the missing folders and the temporary file, so that what cannot be written is known at once.
  /// @param file  where the file will be; messages name it as given here
  /// @throws OutputError if it is a folder or a device, is write-protected, or its folder cannot be written to
  explicit PartialFile(const std::filesystem::path& file);
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

  /// Absolute, and with the extension of the final name: for libraries that open files by name. They must not delete
  /// it.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

  /// Appends bytes. @throws OutputError with the system's reason
  void write(std::string_view bytes);

  /// Writes over bytes that are there already. @throws OutputError with the system's reason
  void overwrite(std::uint64_t offset, std::string_view bytes);

  /// Takes over the bytes of another file in its folder, which is gone then. @throws OutputError
  void adopt(const std::filesystem::path& other);

  /// Throws the system's reason why nothing more can be written, if there is one: for libraries that fail without a
  /// word. What was in the temporary file is lost.
  /// @throws OutputError
  void require_space();

  /// Stores the bytes safely and gives the file its name: its own, or partial_name() of it if it ended early.
  /// @returns its size [bytes]
  /// @throws OutputError
  std::uintmax_t commit(Ending ending = Ending::complete);

  /// The name under which commit() puts the file.
  [[nodiscard]] std::filesystem::path name(Ending ending) const;

 private:
  void open_temporary();
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path file_, partial_, target_, temporary_;
  int descriptor_ = -1;
};

/// Writes all bytes to an open file. @returns 0 or the error number
int write_all(int descriptor, std::string_view bytes);

/// Makes new names in a folder survive a power cut. Some file systems cannot do it, which is no reason to fail.
void sync_folder(const std::filesystem::path& folder);

/// Finds out now whether a file can be written, for who writes it after hours of work. Leaves nothing behind.
/// @throws OutputError as PartialFile
void require_writable(const std::filesystem::path& file);

/// Writes a whole file, or leaves everything as it was. @returns its size [bytes] @throws OutputError as PartialFile
std::uintmax_t write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

}  // namespace drape
