#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "import/number_bytes.hpp"
#include "import/zip_reader.hpp"

namespace drape {

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
