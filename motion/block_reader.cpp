#include "motion/block_reader.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "core/error.hpp"
#include "core/text.hpp"
#include "motion/block_writer.hpp"
#include "motion/packing.hpp"

namespace drape {
namespace {

constexpr std::uint64_t head_size = 16, tag_size = 4;

}  // namespace

BlockReader::BlockReader(std::filesystem::path file, const std::string& magic, const std::string& what,
                         std::uint64_t limit)
    : file_(std::move(file)), descriptor_(::open(file_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_ < 0 && (errno == ENOENT || errno == ENOTDIR)) fail("no such file");
  if (descriptor_ < 0) fail("the file cannot be read: " + std::generic_category().message(errno));
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) fail("this is not a regular file");
  size_ = std::min(limit, static_cast<std::uint64_t>(status.st_size));
  const std::string begin = bytes(0, std::min<std::uint64_t>(magic.size(), size_));
  const std::string name = magic.substr(0, magic.find_last_of(' ') + 1);
  if (!begin.starts_with(name)) fail(fmt::format("this is not a drape {}", what));
  if (begin == magic) return;
  const std::string version = begin.substr(name.size(), begin.find('\n') - name.size());
  fail(fmt::format("this {} has version {}, but this drape reads version {}", what, escape_controls(version),
                   magic.substr(name.size(), magic.size() - name.size() - 1)));
}

std::string BlockReader::bytes(std::uint64_t begin, std::uint64_t count) const {
  if (begin > size_ || count > size_ - begin) fail("the file is cut short");
  std::string result(count, '\0');
  for (std::uint64_t done = 0; done < count;) {
    const ssize_t got = ::pread(descriptor_, result.data() + done, count - done, static_cast<off_t>(begin + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("the file cannot be read: " + std::generic_category().message(errno));
    if (got == 0) fail("the file is cut short");
    done += static_cast<std::uint64_t>(got);
  }
  return result;
}

Block BlockReader::first_bytes(std::uint64_t begin, std::uint64_t count) const {
  const std::string head = bytes(begin, head_size);
  const std::uint64_t size = ByteReader(std::string_view(head).substr(tag_size)).whole();
  if (size > size_ - begin - head_size) fail("the file is cut short, or has a part of a size that cannot be");
  return {head.substr(0, tag_size), bytes(begin + head_size, std::min(size, count)), begin + head_size + size};
}

Block BlockReader::block(std::uint64_t begin) const {
  Block block = first_bytes(begin, UINT64_MAX);
  if (block_head(block.tag, block.payload) != bytes(begin, head_size)) {
    fail(fmt::format("the file is damaged: the checksum of what is at byte {} is wrong", begin));
  }
  return block;
}

void BlockReader::fail(const std::string& message) const {
  throw UsageError(shown(file_) + ": " + escape_controls(message));
}

}  // namespace drape
