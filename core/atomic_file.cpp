#include "core/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include "core/error.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail_to_write(const fs::path& file, std::string_view reason) {
  throw OutputError(fmt::format("cannot write {}: {}", file.string(), reason));
}

/// The file that a chain of symbolic links ends at, which need not exist.
fs::path followed(const fs::path& file) {
  constexpr int most_links = 40;  // as Linux
  fs::path target = fs::absolute(file);
  for (int i = 0; fs::is_symlink(fs::symlink_status(target)); ++i) {
    if (i == most_links) fail_to_write(file, std::generic_category().message(ELOOP));
    target = target.parent_path() / fs::read_symlink(target);
  }
  return target;
}

/// Several threads may write files of one name to one folder; the number keeps them apart.
fs::path temporary_name(const fs::path& target) {
  static std::atomic<unsigned> count = 0;
  // The longest name a folder takes is 255 bytes.
  constexpr std::size_t longest_stem = 100, longest_extension = 16;
  const std::string extension = target.extension().string();
  return target.parent_path() / fmt::format(".{}.partial-{}-{}{}", target.stem().string().substr(0, longest_stem),
                                            ::getpid(), count++, extension.size() > longest_extension ? "" : extension);
}

/// @returns 0 or the error number
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// So that the new name survives a power cut. Some file systems cannot do it, which is no reason to fail.
void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

PartialFile::PartialFile(const fs::path& file) : file_(file) {
  if (!file.has_filename()) fail_to_write(file, "a file name is missing");
  try {
    target_ = followed(file);
    fs::create_directories(target_.parent_path());
  } catch (const fs::filesystem_error& error) {
    fail_to_write(file, error.code().message());
  }

  struct stat status {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail_to_write(file, "it is a folder");
  if (exists && !S_ISREG(status.st_mode)) fail_to_write(file, "it is not a regular file");
  if (exists && ::access(target_.c_str(), W_OK) != 0) fail(errno);

  temporary_ = temporary_name(target_);
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(errno);
  if (exists)
    static_cast<void>(::fchmod(descriptor_, status.st_mode & 07777));  // not every file system has permissions
}

PartialFile::~PartialFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(temporary_.c_str());
}

void PartialFile::write(std::string_view bytes) {
  if (const int error_number = write_all(descriptor_, bytes)) fail(error_number);
}

void PartialFile::require_space() {
  // More than the end of the last block, which is free on a full disk too.
  const std::string bytes(1 << 20, '\0');
  if (::lseek(descriptor_, 0, SEEK_END) < 0) fail(errno);
  write(bytes);
}

std::uintmax_t PartialFile::commit() {
  struct stat status {};
  if (::fsync(descriptor_) != 0 || ::fstat(descriptor_, &status) != 0) fail(errno);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
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
