#include "core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/text.hpp"
#include "drape/core/error.hpp"

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

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& message) {
  throw UsageError(shown(file) + ": " + escape_controls(message));
}

[[noreturn]] void fail_by_system(const std::filesystem::path& file) {
  if (errno == ENOENT || errno == ENOTDIR) fail(file, "no such file");
  fail(file, "the file cannot be read: " + std::generic_category().message(errno));
}

/// Accepts regular files and pipes: they have an end, and opening them does not block for ever.
void require_readable_kind(const std::filesystem::path& file) {
  // System calls read a name only up to the first zero byte.
  if (file.native().find('\0') != std::string::npos) fail(file, "no such file");
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) fail_by_system(file);
  if (S_ISDIR(status.st_mode)) fail(file, "this is a folder, not a file");
  if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode)) fail(file, "this is a device or socket, not a file");
}

class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& file) : number_(open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (number_ < 0) fail_by_system(file);
  }
  ~Descriptor() { close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }

 private:
  int number_;
};

}  // namespace

std::string read_file(const std::filesystem::path& file, std::size_t limit) {
  require_readable_kind(file);
  const Descriptor descriptor(file);
  struct stat status {};
  const bool known = fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  const std::size_t expected = known ? static_cast<std::size_t>(status.st_size) : 0;
  // A file over the limit is not read at all; a pipe shows its size only by reading. One more byte detects the end.
  constexpr std::size_t least = 1 << 16;
  std::string bytes(std::min(std::max(expected, least), limit) + 1, '\0');
  std::size_t size = 0;
  while (expected <= limit && size <= limit) {
    if (size == bytes.size()) bytes.resize(std::min(2 * size, limit + 1));
    const ssize_t got = read(descriptor, bytes.data() + size, bytes.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_by_system(file);
    if (got == 0) {
      bytes.resize(size);
      return bytes;
    }
    size += static_cast<std::size_t>(got);
  }
  fail(file, fmt::format("the file is too large: expected at most {} bytes", limit));
}

FilePieces::FilePieces(const std::filesystem::path& file) : file_(file) {
  require_readable_kind(file);
  descriptor_ = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail_by_system(file);
}

FilePieces::~FilePieces() { close(descriptor_); }

bool FilePieces::possible(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::is_regular_file(file, error);
}

void FilePieces::read(std::size_t offset, std::size_t most, std::string& bytes) const {
  bytes.resize(most);
  std::size_t size = 0;
  while (size < most) {
    const ssize_t got = pread(descriptor_, bytes.data() + size, most - size, static_cast<off_t>(offset + size));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_by_system(file_);
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  bytes.resize(size);
}

std::string text_of(const std::filesystem::path& file, std::string text) {
  constexpr std::string_view utf8 = "\xEF\xBB\xBF", utf16_little = "\xFF\xFE", utf16_big = "\xFE\xFF";
  if (text.starts_with(utf16_little) || text.starts_with(utf16_big)) {
    fail(file, "the file is text in UTF-16: save it as UTF-8");
  }
  if (text.find('\0') != std::string::npos) fail(file, "this is a binary file, not a text");
  if (text.starts_with(utf8)) text.erase(0, utf8.size());
  return text;
}

std::string read_text(const std::filesystem::path& file, std::size_t limit) {
  return text_of(file, read_file(file, limit));
}

namespace fs = std::filesystem;

fs::path link_target(const fs::path& file) {
  constexpr int most_links = 40;  // same limit as Linux
  fs::path target = fs::absolute(file);
  for (int i = 0; fs::is_symlink(fs::symlink_status(target)); ++i) {
    if (i == most_links) throw fs::filesystem_error("", file, std::error_code(ELOOP, std::generic_category()));
    target = target.parent_path() / fs::read_symlink(target);
  }
  return target;
}

std::string file_identity(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) == 0) {
    return "inode " + std::to_string(status.st_dev) + " " + std::to_string(status.st_ino);
  }
  try {
    const fs::path target = link_target(file);
    return (fs::weakly_canonical(target.parent_path()) / target.filename()).string();
  } catch (const fs::filesystem_error&) {
    std::error_code ignored;  // opening the file will report the problem
    return fs::absolute(file, ignored).lexically_normal().string();
  }
}

namespace fs = std::filesystem;
namespace {

/// Time within which a new folder gets its lock [s].
constexpr std::time_t unlocked = 60;

int open_folder(const fs::path& folder) {
  return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

/// Removes a folder of this user that no process has locked any more.
void clear_folder(const fs::path& folder) {
  const int descriptor = open_folder(folder);
  if (descriptor < 0) return;
  struct stat status {};
  const bool old = ::fstat(descriptor, &status) == 0 && status.st_uid == ::geteuid() &&
                   std::time(nullptr) - status.st_mtime >= unlocked;
  std::error_code ignored;
  if (old && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) fs::remove_all(folder, ignored);
  ::close(descriptor);
}

void clear_away_all(const fs::path& place, const std::string& prefix) {
  std::error_code error;
  fs::directory_iterator entry(place, error);
  while (!error && entry != fs::directory_iterator()) {
    if (entry->path().filename().native().starts_with(prefix)) clear_folder(entry->path());
    entry.increment(error);
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder(const std::string& kind) {
  std::error_code error;
  const fs::path place = fs::temp_directory_path(error);
  if (!error) clear_away_all(place, kind + "-");
  std::string name = (place / (kind + "-XXXXXX")).string();
  if (error || ::mkdtemp(name.data()) == nullptr) {
    const std::string reason = error ? error.message() : std::generic_category().message(errno);
    throw OutputError(fmt::format("cannot make a temporary folder in {}: {}", shown(place), reason));
  }
  path_ = name;
  descriptor_ = open_folder(path_);
  static_cast<void>(
      ::flock(descriptor_, LOCK_EX | LOCK_NB));  // on file systems without locks no folder is cleared away
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (descriptor_ >= 0) ::close(descriptor_);
}

namespace {

/// A file without a name. File systems that have none get one whose name is removed at once.
int open_nameless(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor >= 0) return descriptor;
  std::string name = (folder / ".drape-spool-XXXXXX").string();
  const int named = ::mkstemp(name.data());
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

}  // namespace

Spool::Spool(const PartialFile& output, std::string kept)
    : problem_(fmt::format("cannot write {}: {} have to be kept in its folder until the last one is there",
                           shown(output.file()), kept)) {
  open(output.temporary().parent_path());
}

Spool::Spool(std::string kept) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  problem_ = fmt::format("cannot keep {} in {}", kept, shown(folder));
  open(folder);
}

void Spool::open(const std::filesystem::path& folder) {
  const int descriptor = open_nameless(folder);
  if (descriptor < 0) fail(errno);
  stream_.reset(::fdopen(descriptor, "w+b"));
  if (!stream_) fail(errno);
}

void Spool::append(std::string_view bytes) {
  if (bytes.empty()) return;  // an empty view may have no address
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_.get()) != bytes.size()) fail(errno);
  size_ += bytes.size();
}

void Spool::rewind() {
  if (std::fflush(stream_.get()) != 0 || std::fseek(stream_.get(), 0, SEEK_SET) != 0) fail(errno);
}

void Spool::read(void* bytes, std::size_t count) {
  if (std::fread(bytes, 1, count, stream_.get()) != count) fail(EIO);
}

void Spool::copy_to(PartialFile& file) {
  rewind();
  std::string piece(1 << 20, '\0');
  for (std::uint64_t left = size_; left > 0; left -= piece.size()) {
    piece.resize(std::min<std::uint64_t>(left, piece.size()));
    read(piece.data(), piece.size());
    file.write(piece);
  }
}

void Spool::fail(int error_number) const {
  throw OutputError(fmt::format("{}: {}", problem_, std::generic_category().message(error_number)));
}

}  // namespace drape
