#include "core/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "core/file_identity.hpp"
#include "core/text.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail_to_write(const fs::path& file, std::string_view reason) {
  throw OutputError(fmt::format("cannot write {}: {}", shown(file), reason));
}

/// Returns the temporary file's name. Numbers start at 0: several processes and threads may write one target at once.
fs::path temporary_name(const fs::path& target, int number) {
  // A file name has at most 255 bytes.
  constexpr std::size_t longest_stem = 100, longest_extension = 16;
  const std::string extension = target.extension().string();
  return target.parent_path() / fmt::format(".{}.partial-{}{}", target.stem().string().substr(0, longest_stem), number,
                                            extension.size() > longest_extension ? "" : extension);
}

enum class Lock { held, taken, unavailable };

/// Locks an open file, then checks its name: the previous owner may just have renamed or removed the file.
Lock lock(int descriptor, const fs::path& name) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) return errno == EWOULDBLOCK ? Lock::taken : Lock::unavailable;
  struct stat opened {
  }, named{};
  const bool same = ::fstat(descriptor, &opened) == 0 && ::lstat(name.c_str(), &named) == 0 &&
                    opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
  return same ? Lock::held : Lock::taken;
}

/// Removes a temporary file that nobody writes any more. It stays if the file system has no locks.
/// @returns true if such a file exists or has just been removed
bool clear_away(const fs::path& name) {
  const int descriptor = ::open(name.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return errno == EACCES || errno == ELOOP;  // another user's, or a symbolic link
  if (lock(descriptor, name) == Lock::held) ::unlink(name.c_str());
  ::close(descriptor);
  return true;
}

}  // namespace

int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

fs::path partial_name(const fs::path& file) {
  constexpr std::size_t longest_name = 255;
  const std::string ending = ".partial" + file.extension().string();
  const std::string stem = file.stem().string();
  return file.parent_path() / (stem.substr(0, longest_name - std::min(longest_name, ending.size())) + ending);
}

PartialFile::PartialFile(const fs::path& file) : file_(file) {
  if (!file.has_filename()) fail_to_write(file, "a file name is missing");
  // System calls read a name only up to the first zero byte.
  if (file.native().find('\0') != std::string::npos) fail_to_write(file, "its name has a zero byte");
  try {
    target_ = link_target(file);
    partial_ = partial_name(fs::is_symlink(file) ? target_ : file);
    fs::create_directories(target_.parent_path());
  } catch (const fs::filesystem_error& error) {
    fail_to_write(file, error.code().message());
  }

  struct stat status {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail_to_write(file, "it is a folder");
  if (exists && !S_ISREG(status.st_mode)) fail_to_write(file, "it is not a regular file");
  if (exists && ::access(target_.c_str(), W_OK) != 0) fail(errno);

  open_temporary();
  if (exists)
    static_cast<void>(::fchmod(descriptor_, status.st_mode & 07777));  // not every file system has permissions
}

PartialFile::~PartialFile() {
  if (descriptor_ < 0) return;
  ::unlink(temporary_.c_str());  // while it is still locked: afterwards another process may own the name
  ::close(descriptor_);
}

void PartialFile::open_temporary() {
  int number = 0;
  for (; descriptor_ < 0; ++number) {
    temporary_ = temporary_name(target_, number);
    clear_away(temporary_);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) fail(errno);
    if (descriptor_ >= 0 && lock(descriptor_, temporary_) == Lock::taken) {
      // Another process has locked it: it took the file for an abandoned one.
      ::close(descriptor_);
      descriptor_ = -1;
    }
  }
  while (clear_away(temporary_name(target_, number))) ++number;
}

void PartialFile::write(std::string_view bytes) {
  if (const int error_number = write_all(descriptor_, bytes)) fail(error_number);
}

void PartialFile::overwrite(std::uint64_t offset, std::string_view bytes) {
  if (::lseek(descriptor_, static_cast<off_t>(offset), SEEK_SET) < 0) fail(errno);
  write(bytes);
  if (::lseek(descriptor_, 0, SEEK_END) < 0) fail(errno);
}

void PartialFile::adopt(const fs::path& other) {
  struct stat status {};
  const int descriptor = ::open(other.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor < 0 || ::fstat(descriptor_, &status) != 0) fail(errno);
  static_cast<void>(lock(descriptor, other));
  static_cast<void>(::fchmod(descriptor, status.st_mode & 07777));
  if (::rename(other.c_str(), temporary_.c_str()) != 0) {
    const int error_number = errno;
    ::close(descriptor);
    fail(error_number);
  }
  ::close(descriptor_);
  descriptor_ = descriptor;
}

void PartialFile::require_space() {
  // One MiB exceeds the unused end of the last block, which is writable even on a full disk.
  const std::string bytes(1 << 20, '\0');
  if (::lseek(descriptor_, 0, SEEK_END) < 0) fail(errno);
  write(bytes);
}

fs::path PartialFile::name(Ending ending) const { return ending == Ending::complete ? file_ : partial_; }

std::uintmax_t PartialFile::commit(Ending ending) {
  struct stat status {};
  if (::fsync(descriptor_) != 0 || ::fstat(descriptor_, &status) != 0) fail(errno);
  const fs::path target = ending == Ending::complete ? target_ : partial_name(target_);
  if (::rename(temporary_.c_str(), target.c_str()) != 0) fail(errno);
  ::close(descriptor_);
  descriptor_ = -1;
  sync_folder(target_.parent_path());
  return static_cast<std::uintmax_t>(status.st_size);
}

void PartialFile::fail(int error_number) const { fail_to_write(file_, std::generic_category().message(error_number)); }

void require_writable(const fs::path& file) {
  std::error_code ignored;
  std::vector<fs::path> missing;  // folders, the innermost first
  for (fs::path folder = fs::absolute(file).parent_path(); !fs::exists(folder, ignored);
       folder = folder.parent_path()) {
    missing.push_back(folder);
  }
  { const PartialFile probe(file); }
  for (const fs::path& folder : missing) fs::remove(folder, ignored);
}

std::uintmax_t write_file_atomically(const fs::path& file, std::string_view bytes) {
  PartialFile partial(file);
  partial.write(bytes);
  return partial.commit();
}

}  // namespace drape
