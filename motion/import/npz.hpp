#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// Type of a number in a file.
struct NumberType {
  enum class Kind { integer, natural, real };

  Kind kind = Kind::real;
  std::size_t size = 8;     ///< [bytes]: 1, 2, 4 or 8; 4 or 8 for real
  bool big_endian = false;  ///< most significant byte first
};

/// Decodes a number.
/// @param bytes type.size bytes
inline double number_at(const char* bytes, const NumberType& type) {
  char ordered[8] = {};
  std::memcpy(ordered, bytes, type.size);
  if (type.big_endian) std::reverse(ordered, ordered + type.size);
  const auto as = [&](auto number) {
    std::memcpy(&number, ordered, sizeof number);
    return static_cast<double>(number);
  };
  static_assert(std::endian::native == std::endian::little);
  switch (type.kind) {
    case NumberType::Kind::real:
      return type.size == 4 ? as(float{}) : as(double{});
    case NumberType::Kind::integer:
      return type.size == 1   ? as(std::int8_t{})
             : type.size == 2 ? as(std::int16_t{})
             : type.size == 4 ? as(std::int32_t{})
                              : as(std::int64_t{});
    case NumberType::Kind::natural:
      break;
  }
  return type.size == 1   ? as(std::uint8_t{})
         : type.size == 2 ? as(std::uint16_t{})
         : type.size == 4 ? as(std::uint32_t{})
                          : as(std::uint64_t{});
}

/// Decodes consecutive numbers; ignores an incomplete one at the end.
inline std::vector<double> numbers_in(std::string_view bytes, const NumberType& type) {
  std::vector<double> numbers(bytes.size() / type.size);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = number_at(bytes.data() + i * type.size, type);
  return numbers;
}

/// A ZIP archive whose members are read as streams.
class ZipReader {
 public:
  struct Member {
    std::string name;
    std::uint64_t offset = 0;            // offset of its local header
    std::uint64_t packed = 0, size = 0;  // [bytes]
    bool deflated = false;
  };

  /// @throws UsageError "file: message" unless it is a complete archive
  explicit ZipReader(std::filesystem::path file);

  [[nodiscard]] const std::vector<Member>& members() const { return members_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::vector<Member> members_;
};

/// Sequential reader of an archive member.
class ZipStream {
 public:
  /// @throws UsageError "file: message"
  ZipStream(const ZipReader& zip, const ZipReader::Member& member);
  ~ZipStream();
  ZipStream(const ZipStream&) = delete;
  ZipStream& operator=(const ZipStream&) = delete;

  /// Reads the next bytes. @throws UsageError if there are fewer
  std::string read(std::size_t count);
  [[nodiscard]] std::uint64_t left() const { return left_; }

 private:
  struct Inflater;
  [[noreturn]] void fail_cut() const;

  std::string name_;
  std::ifstream stream_;
  std::uint64_t packed_left_, left_;
  std::unique_ptr<Inflater> inflater_;  // null for a stored member
};

/// An array of an .npz, read row by row.
class NpyStream {
 public:
  /// @throws UsageError "file: array: message" unless it is an array of numbers in C order
  NpyStream(const ZipReader& zip, const ZipReader::Member& member);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::vector<std::size_t>& shape() const { return shape_; }
  /// Returns the length of the first axis; 1 for a single number.
  [[nodiscard]] std::size_t rows() const { return shape_.empty() ? 1 : shape_.front(); }
  /// Returns the numbers per row; for records those of all fields.
  [[nodiscard]] std::size_t row_size() const;
  /// Returns the fields of records; empty for plain numbers.
  [[nodiscard]] const std::vector<std::string>& fields() const { return fields_; }

  /// Reads the next row.
  [[nodiscard]] std::vector<double> row();
  /// Reads all remaining rows.
  [[nodiscard]] std::vector<double> rest();

  [[noreturn]] void fail(const std::string& message) const;

 private:
  void read_header();

  ZipStream stream_;
  std::string name_;
  NumberType type_;
  std::vector<std::string> fields_;
  std::vector<std::size_t> shape_;
  std::size_t next_ = 0;
};

/// Returns the array of the first name that the archive contains; null if it has none of them.
/// @throws UsageError as NpyStream
std::unique_ptr<NpyStream> array_named(const ZipReader& zip, std::initializer_list<std::string> names);

}  // namespace drape
