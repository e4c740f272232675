#pragma once

#include <unistd.h>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drape {

/// An open file descriptor, closed by the destructor.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept { return std::swap(number_, other.number_), *this; }

  operator int() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_ = -1;
};

// Encoding of a motion file's parts as bytes, see docs/reference/motion-file.md. Invalid bytes throw a
// std::invalid_argument whose text completes "the file …".

/// Compresses bytes: their number, followed by a zlib stream.
std::string pack(std::string_view bytes);
/// Compresses words whose byte planes are either constant or noise: much faster, and hardly larger.
std::string pack_planes(const std::vector<std::uint64_t>& words);

/// Decompresses bytes. Memory is limited by the packed size and by `most`.
/// @param most largest number of bytes
std::string unpack(std::string_view packed, std::uint64_t most = UINT64_MAX);
/// Decompresses exactly `count` words.
std::vector<std::uint64_t> unpack_planes(std::string_view packed, std::size_t count);

/// Writer of numbers as bytes, little endian, one after another.
class ByteWriter {
 public:
  ByteWriter& whole(std::uint64_t number);
  ByteWriter& number(double value);
  ByteWriter& bytes(std::string_view more) { return bytes_ += more, *this; }
  [[nodiscard]] const std::string& text() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reader of such numbers.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t whole();
  double number();
  /// Returns all remaining bytes.
  [[nodiscard]] std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
};

struct Block {
  std::string tag, payload;
  std::uint64_t end = 0;  ///< start of the next block
};

/// Random-access reader of a file of blocks; it validates all bytes. Errors are UsageErrors that name the file.
class BlockReader {
 public:
  /// @param magic  first line of the file; its last word is the version: "drape recorded motion 1\n"
  /// @param what   kind of file for messages: "motion"
  /// @param limit  number of valid bytes of the file
  BlockReader(std::filesystem::path file, const std::string& magic, const std::string& what,
              std::uint64_t limit = UINT64_MAX);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Reads the block at an offset and verifies its checksum.
  [[nodiscard]] Block block(std::uint64_t begin) const;
  /// Reads tag, first bytes and end of a block without the rest of it.
  [[nodiscard]] Block first_bytes(std::uint64_t begin, std::uint64_t count) const;
  [[nodiscard]] std::string bytes(std::uint64_t begin, std::uint64_t count) const;

  /// @throws UsageError "file: message"
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::filesystem::path file_;
  Descriptor descriptor_;
  std::uint64_t size_ = 0;
};

/// Returns the header of a block: tag, payload size, and a checksum of both and the payload.
std::string block_head(std::string_view tag, std::string_view payload);

/// Removes a file of blocks. @throws UsageError if another process is writing it
void remove_unless_written(const std::filesystem::path& file);

/// A growing file of blocks, visible under its name and locked while open.
class BlockWriter {
 public:
  /// Creates a file. @throws UsageError if it exists; OutputError if it cannot be created
  BlockWriter(std::filesystem::path file, std::string_view magic);
  /// Appends after the first `size` bytes of a file and discards the rest.
  /// @throws UsageError if another process is writing it; OutputError if it cannot be written
  BlockWriter(std::filesystem::path file, std::uint64_t size);

  /// Appends a block. @returns its offset @throws OutputError
  std::uint64_t add(std::string_view tag, std::string_view payload);
  /// Appends bytes. @throws OutputError
  void write(std::string_view bytes);
  /// Waits until all bytes are on disk. @throws OutputError
  void sync();
  /// Syncs the file and renames it; nothing can be added afterwards. @throws OutputError
  void complete_as(const std::filesystem::path& name);

  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path file_;
  Descriptor descriptor_;
  std::uint64_t size_ = 0;
};

}  // namespace drape
