#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "scene/usd/layer.hpp"
#include "scene/usd/lexer.hpp"

namespace drape {

/// Element type of a USD attribute.
struct UsdType {
  enum class Kind { number, text, other };
  Kind kind = Kind::other;
  std::size_t rows = 0, columns = 0;  ///< 1×1 for a number, 1×n for a tuple, n×n for a matrix

  [[nodiscard]] std::size_t components() const { return rows * columns; }
};

/// Returns the type of a name in a usda file, without the brackets of an array; `other` unless it consists of numbers
/// or text. The names: https://openusd.org/release/api/_usd__page__datatypes.html
UsdType usd_type(std::string_view name);

/// Parses a value of an attribute at the lexer's token and moves past it; returns nothing for None.
/// @param type type of the attribute, numbers or text
/// @throws UsageError unless it has the attribute's shape and finite numbers
std::optional<UsdValue> parse_usd_value(const SourceText& source, UsdLexer& lexer, const UsdAttribute& attribute,
                                        const UsdType& type);

/// Returns a value of an attribute; a located value is read from the file. @throws UsageError as parse_usd_value()
UsdValue usd_value_of(const UsdAttribute& attribute, const UsdValue& value);

/// Makes a rotation from real and imaginary parts; zeros give the identity.
Eigen::Quaterniond usd_quaternion(const double* wxyz);

/// Returns the numbers of an attribute at a time [time codes]; empty if it has no value. Samples are interpolated
/// linearly, quaternions along the shortest arc. Between samples of different lengths the earlier one holds; outside of
/// all samples the nearest one holds.
std::vector<double> usd_numbers_at(const UsdAttribute& attribute, double time);

}  // namespace drape
