#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "import/number_bytes.hpp"
#include "import/zip_reader.hpp"

namespace drape {

/// An array of an .npz, whose rows are read one after another.
class NpyStream {
 public:
  /// @throws UsageError "file: array: message" if it is no array of numbers in C's order
  NpyStream(const ZipReader& zip, const ZipReader::Member& member);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::vector<std::size_t>& shape() const { return shape_; }
  /// The length of the first axis; 1 of a single number.
  [[nodiscard]] std::size_t rows() const { return shape_.empty() ? 1 : shape_.front(); }
  /// The numbers of a row; of records those of all fields.
  [[nodiscard]] std::size_t row_size() const;
  /// The fields of records; empty: it holds plain numbers.
  [[nodiscard]] const std::vector<std::string>& fields() const { return fields_; }

  /// The next row.
  [[nodiscard]] std::vector<double> row();
  /// All rows that are left.
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

/// The array of the first of some names that an archive has; null if it has none of them.
/// @throws UsageError as NpyStream
std::unique_ptr<NpyStream> array_named(const ZipReader& zip, std::initializer_list<std::string> names);

}  // namespace drape
