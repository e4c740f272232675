#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "scene/usd/layer.hpp"
#include "scene/usd/lexer.hpp"

namespace drape {

/// What the elements of a USD attribute are made of.
struct UsdType {
  enum class Kind { number, text, other };
  Kind kind = Kind::other;
  std::size_t rows = 0, columns = 0;  ///< 1×1 for a number, 1×n for a tuple, n×n for a matrix

  [[nodiscard]] std::size_t components() const { return rows * columns; }
};

/// A type by its name in a usda file, without the brackets of an array; `other` where it is not made of numbers or
/// text. The names: https://openusd.org/release/api/_usd__page__datatypes.html
UsdType usd_type(std::string_view name);

/// Parses a value of an attribute at the lexer's token, up to behind it; nothing for None.
/// @param type the attribute's, of numbers or text
/// @throws UsageError unless all of it has the attribute's shape, and its numbers are finite
std::optional<UsdValue> parse_usd_value(const SourceText& source, UsdLexer& lexer, const UsdAttribute& attribute,
                                        const UsdType& type);

/// A value of an attribute, read from the file if only its place is known. @throws UsageError as parse_usd_value()
UsdValue usd_value_of(const UsdAttribute& attribute, const UsdValue& value);

/// Real and imaginary parts as a rotation; that of zeros is none.
Eigen::Quaterniond usd_quaternion(const double* wxyz);

/// The numbers of an attribute at a time [time codes]; empty if it has no value. Between its samples they are
/// interpolated linearly, quaternions along the shortest arc, and samples of different lengths not at all: the one
/// before holds. Outside of them the nearest holds.
std::vector<double> usd_numbers_at(const UsdAttribute& attribute, double time);

}  // namespace drape
