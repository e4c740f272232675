#include "core/read_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/text.hpp"

namespace drape {
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

}  // namespace drape
