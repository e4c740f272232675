#include "motion/blocks.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>
#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>
#include <system_error>

#include "core/bytes.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"

namespace drape {
namespace {

// Numbers are stored in the native format of the supported machines.
static_assert(std::endian::native == std::endian::little && std::numeric_limits<double>::is_iec559);

constexpr std::uint64_t most_packed = 1100;  // upper bound of zlib's compression ratio

std::string deflated(std::string_view bytes, int strategy) {
  z_stream stream{};
  if (deflateInit2(&stream, 1, Z_DEFLATED, 15, 9, strategy) != Z_OK) throw std::bad_alloc();
  std::string packed(deflateBound(&stream, bytes.size()) + 64, '\0');
  std::size_t made = 0;
  int result = Z_OK;
  while (result == Z_OK) {  // zlib counts in 32 bits
    constexpr std::size_t piece = std::size_t{1} << 30;
    const auto in = static_cast<uInt>(std::min(bytes.size(), piece));
    const auto out = static_cast<uInt>(std::min(packed.size() - made, piece));
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = in;
    stream.next_out = reinterpret_cast<Bytef*>(packed.data() + made);
    stream.avail_out = out;
    result = deflate(&stream, in == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    bytes.remove_prefix(in - stream.avail_in);
    made += out - stream.avail_out;
  }
  deflateEnd(&stream);
  if (result != Z_STREAM_END) throw std::bad_alloc();
  packed.resize(made);
  return packed;
}

std::string packed(std::string_view bytes, int strategy) {
  return ByteWriter().whole(bytes.size()).bytes(deflated(bytes, strategy)).text();
}

}  // namespace

std::string pack(std::string_view bytes) { return packed(bytes, Z_DEFAULT_STRATEGY); }

std::string pack_planes(const std::vector<std::uint64_t>& words) { return packed(byte_planes(words), Z_RLE); }

std::string unpack(std::string_view packed, std::uint64_t most) {
  ByteReader reader(packed);
  const std::uint64_t size = reader.whole();
  if (size > most) throw std::invalid_argument("has a part of another size than it should have");
  packed = reader.rest();
  if (size / most_packed > packed.size())
    throw std::invalid_argument("says of a part that it is larger than it can be");
  std::string bytes(size, '\0');
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  std::size_t made = 0;
  int result = Z_OK;
  while (result == Z_OK) {
    constexpr std::size_t piece = std::size_t{1} << 30;
    const auto in = static_cast<uInt>(std::min(packed.size(), piece));
    const auto out = static_cast<uInt>(std::min(bytes.size() - made, piece));
    Bytef nothing = 0;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = in;
    stream.next_out = out > 0 ? reinterpret_cast<Bytef*>(bytes.data() + made) : &nothing;
    stream.avail_out = out;
    result = inflate(&stream, Z_NO_FLUSH);
    packed.remove_prefix(in - stream.avail_in);
    made += out - stream.avail_out;
  }
  inflateEnd(&stream);
  if (result != Z_STREAM_END || made != size || !packed.empty()) {
    throw std::invalid_argument("has a part that cannot be unpacked");
  }
  return bytes;
}

std::vector<std::uint64_t> unpack_planes(std::string_view packed, std::size_t count) {
  const std::string bytes = unpack(packed, 8 * std::uint64_t{count});
  if (bytes.size() / 8 != count || bytes.size() % 8 != 0) {
    throw std::invalid_argument("has a part of another size than it should have");
  }
  return from_byte_planes(bytes);
}

ByteWriter& ByteWriter::whole(std::uint64_t number) {
  bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
  return *this;
}

ByteWriter& ByteWriter::number(double value) { return whole(std::bit_cast<std::uint64_t>(value)); }

std::uint64_t ByteReader::whole() {
  std::uint64_t number = 0;
  if (bytes_.size() < sizeof number) throw std::invalid_argument("has a part that is cut off");
  std::memcpy(&number, bytes_.data(), sizeof number);
  bytes_.remove_prefix(sizeof number);
  return number;
}

double ByteReader::number() { return std::bit_cast<double>(whole()); }

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
    fail(fmt::format("the file is damaged: the block at byte {} has a wrong checksum", begin));
  }
  return block;
}

void BlockReader::fail(const std::string& message) const {
  throw UsageError(shown(file_) + ": " + escape_controls(message));
}

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
