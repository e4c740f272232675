#include "motion/block_writer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <system_error>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "motion/packing.hpp"

namespace drape {
namespace {

std::uint32_t checksum(std::uint32_t before, std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// Locks the file exclusively, where the file system supports locks.
void lock_blocks(int descriptor, const std::filesystem::path& file) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  throw UsageError(fmt::format("{} is being written by another process", shown(file)));
}

}  // namespace

std::string block_head(std::string_view tag, std::string_view payload) {
  std::string head = ByteWriter().bytes(tag).whole(payload.size()).text();
  const std::uint32_t sum = checksum(checksum(0, head), payload);
  head.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  return head;
}

void remove_unless_written(const std::filesystem::path& file) {
  const Descriptor descriptor(::open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK));
  if (descriptor >= 0) lock_blocks(descriptor, file);
  std::filesystem::remove(file);
}

BlockWriter::BlockWriter(std::filesystem::path file, std::string_view magic)
    : file_(std::move(file)), descriptor_(::open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0 && errno == EEXIST) throw UsageError(fmt::format("{} already exists", shown(file_)));
  if (descriptor_ < 0) fail(errno);
  lock_blocks(descriptor_, file_);
  write(magic);
}

BlockWriter::BlockWriter(std::filesystem::path file, std::uint64_t size)
    : file_(std::move(file)), descriptor_(::open(file_.c_str(), O_WRONLY | O_CLOEXEC)), size_(size) {
  if (descriptor_ < 0) fail(errno);
  lock_blocks(descriptor_, file_);
  const auto end = static_cast<off_t>(size);
  if (::ftruncate(descriptor_, end) != 0 || ::lseek(descriptor_, end, SEEK_SET) != end) fail(errno);
}

std::uint64_t BlockWriter::add(std::string_view tag, std::string_view payload) {
  const std::uint64_t begin = size_;
  write(block_head(tag, payload));
  write(payload);
  return begin;
}

void BlockWriter::write(std::string_view bytes) {
  if (const int error = write_all(descriptor_, bytes)) fail(error);
  size_ += bytes.size();
}

void BlockWriter::sync() {
  if (::fdatasync(descriptor_) != 0) fail(errno);
}

void BlockWriter::complete_as(const std::filesystem::path& name) {
  sync();
  if (::rename(file_.c_str(), name.c_str()) != 0) fail(errno);
  descriptor_.close();
  sync_folder(std::filesystem::absolute(name).parent_path());
}

void BlockWriter::fail(int error_number) const {
  throw OutputError(fmt::format("cannot write {}: {}", shown(file_), std::generic_category().message(error_number)));
}

}  // namespace drape
